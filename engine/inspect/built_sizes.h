#pragma once
/// What in a scene was built to the size of people: flights of steps, and doorways. Both are told by their
/// proportions alone, so that they are found whatever the scene's scale is.

#include <stop_token>

#include "engine/inspect/surface_probe.h"
#include "engine/scene/scene.h"

namespace acentric {

/// The middle one of the largest group of about the same length.
struct CommonLength {
  double metres = 0;
  int count = 0;  ///< in the group
  int of = 0;     ///< all that were found
};

struct BuiltSizes {
  CommonLength riser;       ///< of steps that at least three more of the same height follow downwards
  CommonLength doorHeight;  ///< from the floor to the lintel, with higher rooms on both sides
  double doorWidth = 0;     ///< metres between the jambs of these, the middle one
};

/// Of very large scenes a sample of the edges and lintels is looked at. Stopped: what was found so far.
BuiltSizes measureBuiltSizes(const Scene& scene, const SurfaceProbe& probe, const std::stop_token& stop = {});

}  // namespace acentric
