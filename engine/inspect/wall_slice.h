#pragma once
/// What of a scene stands upright at one height, in plan: where its corners are, and which way most of it
/// runs. For tools that land on them.

#include <optional>
#include <stop_token>
#include <vector>

#include "engine/scene/scene.h"

namespace acentric {

struct WallSlice {
  std::vector<glm::dvec2> corners;  ///< plan, metres: where pieces of different directions meet
  /// Of the longest share of all upright pieces, within half a turn's quarter: [0, pi/2). Nothing without
  /// any.
  std::optional<double> directionRadians;
};

/// Of the triangles that cross the height (z, metres) and stand within 20 degrees of upright. Stopped: empty.
WallSlice sliceWalls(const Scene& scene, double height, const std::stop_token& stop = {});

}  // namespace acentric
