#pragma once
/// Moves a lattice, within one of its cells, to where its cameras stand freest: a camera in a column sees its
/// inside, and one at a wall sees half of nothing.

#include <stop_token>

#include "engine/inspect/surface_probe.h"
#include "engine/layout/layout.h"

namespace acentric {

struct CrowdingRules {
  double cameraRoom = 0.4;       ///< metres
  double floorTolerance = 0.25;  ///< metres that the floor may lie below the walk plane
  bool trustSides = true;        ///< a camera around which all shows its back is inside a solid
};

/// How badly the cameras of a layout stand: each lacks a share of its room, in [0, 1], or counts 2 inside a
/// solid and off the floor. Looks level at eye height, and down.
double crowding(const Layout& layout, const CrowdingRules& rules, const SurfaceProbe& probe);

struct ShiftOptions {
  CrowdingRules crowding;
  int steps = 6;  ///< each way over the lattice's cell: steps x steps origins are tried
  /// Cameras looked at in all: over very large layouts fewer origins are tried, at last none but the spec's.
  std::size_t mostCameras = 400'000;
  double rounding = 0.01;  ///< metres: origins that a person can read
};

struct LatticeShift {
  glm::dvec2 origin{0};          ///< the freest latticeOrigin found
  double before = 0, after = 0;  ///< crowding
};

/// The spec's own origin wins a tie, then the first tried. Origins where nothing is placed are passed
/// over, and once no camera is crowded no more are tried.
/// Stopped: the best so far.
LatticeShift findFreestOrigin(const LayoutSpec& spec, const ShiftOptions& options, const SurfaceProbe& probe,
                              std::stop_token stop = {});

}  // namespace acentric
