#pragma once
/// Every place where a person can stand, and which of them are a step apart: a graph over a grid with one
/// spot per floor above each cell. Stairs and ramps link spots of different heights.

#include <array>
#include <cstdint>
#include <vector>

#include "engine/inspect/floor_levels.h"

namespace acentric {

class TaskRunner;

struct StandingRules {
  double eyeHeight = 1.6;      ///< metres
  double wallClearance = 0.2;  ///< metres from obstacles between knee and eye
  double stepHeight = 0.25;    ///< metres: what a foot climbs at once
  /// No spots inside a solid. A spot seems to be inside where all around shows its back; a part of the floor
  /// that is walked about without passing a surface is inside where most of its spots seem so. (Models are
  /// often wound the other way in places, and one does not walk out of a solid.)
  bool refuseInside = true;
  double wallReach = 20;  ///< metres: surfaces at eye height up to here enclose who stands there
  /// Metres: halls and squares have walls up to here, which count less and less beyond wallReach. The sky box
  /// around a land is none.
  double farthestWall = 100;
};

struct StandingSpot {
  int x = 0, y = 0;  ///< grid cell
  float height = 0;  ///< of the floor, z, metres
  bool covered = false;
  bool seemsInside = false;  ///< of a solid
  float clearance = 0;       ///< metres to the nearest obstacle in eight directions; infinite: none
  float enclosure = 0;       ///< share of the directions at eye height that meet a surface within wallReach
  float wideEnclosure = 0;   ///< likewise, walls up to farthestWall included: 0..1, at least enclosure
  /// Spots a step away towards +x, +y, -x, -y; -1 = none. If a leads to b, b leads back to a.
  std::array<int, 4> next{-1, -1, -1, -1};
};

struct Standing {
  ProbeGrid grid;
  std::vector<StandingSpot> spots;  ///< row after row, a cell's spots highest first
};

/// Spots joined by steps carry the same number, from 0 on; -1 for those not included.
std::vector<int> numberParts(const Standing& standing, const std::vector<std::uint8_t>& included);

/// Room for a body between knee and eye, and no seeming to be inside a solid. The level has the head room.
bool canStand(const glm::dvec2& place, const FloorLevel& level, const StandingRules& rules,
              const SurfaceProbe& probe);

/// `runner` looks around at many places at a time; without one it is done at one after the other.
Standing surveyStanding(const ProbeGrid& grid, const FloorLevels& levels, const StandingRules& rules,
                        const SurfaceProbe& probe, TaskRunner* runner = nullptr);

}  // namespace acentric
