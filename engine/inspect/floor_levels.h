#pragma once
/// Where one could stand above each point of a grid: the surfaces that rays straight down meet, with the room
/// above.

#include <optional>
#include <vector>

#include "engine/inspect/walkable_outline.h"

namespace acentric {

struct ProbeGrid {
  glm::dvec2 corner{0};  ///< lower left corner of cell (0, 0), metres
  double step = 0;       ///< metres
  int columns = 0, rows = 0;
  glm::dvec2 centreOf(int x, int y) const { return corner + step * glm::dvec2(x + 0.5, y + 0.5); }
};

/// Heights (z) per grid cell that have the head room, highest first.
using FloorLevels = std::vector<std::vector<float>>;

FloorLevels findFloorLevels(const Bounds& bounds, const ProbeGrid& grid, double headRoom,
                            const DistanceProbe& probe);

/// The height with most floor, but a lower one is preferred that has at least 60 % as much: a house's roof is
/// larger than its floor. Nothing if there is no floor at all.
std::optional<double> dominantLevel(const FloorLevels& levels, double tolerance);

}  // namespace acentric
