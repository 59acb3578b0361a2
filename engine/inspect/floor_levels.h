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
  float height = 0;       ///< z, metres
  bool covered = false;   ///< something is above
  bool faceDown = false;  ///< as wound: a solid's underside, or a sheet wound the other way
  /// The surface above shows its back to who stands here, or this one faces down and fewer solids were left
  /// than entered above it. Only what is around can tell: see canStand.
  bool maybeInside = false;
};

/// Levels per grid cell that have the head room, highest first.
using FloorLevels = std::vector<std::vector<FloorLevel>>;

/// Surfaces less steep than 60 degrees at one place of the plan, highest first. Either side may face up:
/// models have floors of sheets wound the other way.
std::vector<FloorLevel> floorLevelsAt(const glm::dvec2& place, const Bounds& bounds, double headRoom,
                                      const SurfaceProbe& probe);

FloorLevels findFloorLevels(const Bounds& bounds, const ProbeGrid& grid, double headRoom,
                            const SurfaceProbe& probe);

struct WeightedHeight {
  float height = 0;   ///< z, metres
  double weight = 1;  ///< > 0: for the choice among heights
  double pull = 1;    ///< > 0: for the middle of those that are chosen
};

/// The height with most weight, but a lower one is preferred that has at least 60 % as much: a house's roof
/// is larger than its floor. Of the heights within the tolerance, the middle one by pull. Nothing if there
/// are no heights.
std::optional<double> dominantHeight(std::vector<WeightedHeight> heights, double tolerance);

}  // namespace acentric
