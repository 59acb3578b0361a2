#pragma once
/// The floor that a project stands on: which sides of surfaces count, which height, and which part of it. The
/// walkable area and the list of the storeys both follow this choice.

#include "engine/inspect/standing.h"
#include "engine/inspect/walk_plane.h"
#include "engine/inspect/walkable_outline.h"

namespace acentric {

struct FloorChoice {
  WalkableArea area;
  WalkPlane plane;    ///< of `area`, at its height
  Standing standing;  ///< every place to stand, with the sides ignored where `area` says so
};

/// notFound where there is no floor at all. `options` are checked already.
Result<FloorChoice> chooseFloor(const Bounds& bounds, const ProbeGrid& grid, const WalkableOptions& options,
                                const SurfaceProbe& probe);

}  // namespace acentric
