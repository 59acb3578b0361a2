#pragma once
/// Surfaces that could be floor above each point of a grid: rays straight down, with the room above.

#include <optional>
#include <vector>

#include "engine/inspect/surface_probe.h"
#include "engine/scene/scene.h"

namespace acentric {

struct ProbeGrid {
  glm::dvec2 corner{0};  ///< lower left corner of cell (0, 0), metres
  double step = 0;       ///< metres
  int columns = 0, rows = 0;
  glm::dvec2 centreOf(int x, int y) const { return corner + step * glm::dvec2(x + 0.5, y + 0.5); }
  std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(columns) + std::size_t(x); }
};

struct FloorLevel {
  float height = 0;          ///< z, metres
  bool covered = false;      ///< something is above
  bool coverIsBack = false;  ///< ... and shows its back to who stands here: a solid's top, from within
};

/// Levels per grid cell that have the head room, highest first.
using FloorLevels = std::vector<std::vector<FloorLevel>>;

struct FloorRules {
  double headRoom = 1.75;  ///< metres
  /// Only surfaces less steep than 60 degrees that face upwards. A surface that faces down is still a floor
  /// where no solid was entered above it: sheets are wound either way. False: every surface is a floor.
  bool upwardOnly = true;
};

/// At one place of the plan, highest first.
std::vector<FloorLevel> floorLevelsAt(const glm::dvec2& place, const Bounds& bounds, const FloorRules& rules,
                                      const SurfaceProbe& probe);

FloorLevels findFloorLevels(const Bounds& bounds, const ProbeGrid& grid, const FloorRules& rules,
                            const SurfaceProbe& probe);

/// The height with most floor, but a lower one is preferred that has at least 60 % as much: a house's roof is
/// larger than its floor. Nothing if there is no floor at all.
std::optional<double> dominantLevel(const FloorLevels& levels, double tolerance);

}  // namespace acentric
