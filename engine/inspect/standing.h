#pragma once
/// Every place where a person can stand, and which of them are a step apart: a graph over a grid with one
/// spot per floor above each cell. Stairs and ramps link spots of different heights.

#include <array>
#include <cstdint>
#include <vector>

#include "engine/inspect/floor_levels.h"

namespace acentric {

struct StandingRules {
  double eyeHeight = 1.6;      ///< metres
  double wallClearance = 0.2;  ///< metres from obstacles between knee and eye
  double stepHeight = 0.25;    ///< metres: what a foot climbs at once
  bool refuseInside = true;    ///< no spot where all around shows its back: inside a solid
};

struct StandingSpot {
  int x = 0, y = 0;  ///< grid cell
  float height = 0;  ///< of the floor, z, metres
  bool covered = false;
  /// Spots a step away towards +x, +y, -x, -y; -1 = none. If a leads to b, b leads back to a.
  std::array<int, 4> next{-1, -1, -1, -1};
};

struct Standing {
  ProbeGrid grid;
  std::vector<StandingSpot> spots;  ///< row after row, a cell's spots highest first
};

/// Room for a body between knee and eye, outside of solids. The level has the head room.
bool canStand(const glm::dvec2& place, const FloorLevel& level, const StandingRules& rules,
              const SurfaceProbe& probe);

Standing surveyStanding(const ProbeGrid& grid, const FloorLevels& levels, const StandingRules& rules,
                        const SurfaceProbe& probe);

}  // namespace acentric
