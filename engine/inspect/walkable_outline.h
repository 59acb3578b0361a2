#pragma once
/// Where a person can stand: found by casting rays down on a grid. The designer may edit the result.
///
/// A probe tells distances, not which side of a surface it met, so a closed solid that is higher than the
/// head room looks like a room from within: where its underside is as large as the real floor, give the floor
/// height.

#include <functional>
#include <glm/glm.hpp>

#include "engine/base/result.h"
#include "engine/geometry/outline.h"
#include "engine/scene/scene.h"

namespace acentric {

struct WalkableOptions {
  double eyeHeight = 1.6;        ///< metres of head room needed = eyeHeight + 0.15
  double floorTolerance = 0.25;  ///< metres: floors within this of the chosen height count
  double wallClearance = 0.2;    ///< metres from obstacles
  double gridStep = 0;           ///< metres; 0 = from the scene's size (about 200 x 200 points)
  double floorHeight = std::numeric_limits<double>::quiet_NaN();  ///< NaN = the height with most
                                                                  ///< upward-facing area at walkable height
};

struct WalkableArea {
  double floorHeight = 0;
  Outline outline;  ///< largest connected area, simplified to about one grid step
};

/// Distance along a ray to the nearest surface (infinity = none); origin, unit direction. Injected: inspect
/// does not trace.
using DistanceProbe = std::function<double(const glm::dvec3& origin, const glm::dvec3& direction)>;

Result<WalkableArea> findWalkableArea(const Bounds& bounds, const WalkableOptions& options,
                                      const DistanceProbe& probe);

}  // namespace acentric
