#pragma once
/// What is around a point: how near the nearest surface is, and whether the point is inside a solid.

#include <optional>

#include "engine/inspect/surface_probe.h"

namespace acentric {

struct Surroundings {
  double nearest = std::numeric_limits<double>::infinity();  ///< metres, of all directions looked into
  glm::dvec3 towards{0};                                     ///< unit, to the nearest surface
  int directions = 0;  ///< looked into: level, half up, half down, straight up and down
  int backs = 0;       ///< where the first surface showed its back
  int odd = 0;         ///< where an odd number of surfaces lies on the way out; counted only when in doubt
  std::optional<double> floor;  ///< z of the first surface straight down, metres

  /// Inside a closed solid all directions show backs. Solids are often open, and half of the backs are enough
  /// where the way out also crosses an odd number of surfaces in many directions.
  bool inside() const {
    return 5 * backs > 4 * directions || (2 * backs > directions && 5 * odd > 2 * directions);
  }
};

Surroundings lookAround(const glm::dvec3& point, const SurfaceProbe& probe);

/// Is nothing nearer than `room` metres? Looks into the same directions, and stops at the first that is not
/// free.
bool hasRoom(const glm::dvec3& point, double room, const SurfaceProbe& probe);

}  // namespace acentric
