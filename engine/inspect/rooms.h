#pragma once
/// Rooms of a walkable area: what stays connected when everything nearer to its border than half a door is
/// taken away.

#include <vector>

#include "engine/inspect/standing_area.h"

namespace acentric {

struct RoomOptions {
  double door = 1.2;       ///< metres: passages up to this wide part rooms
  double leastArea = 0.5;  ///< square metres of what is left of a room; smaller ones are none
};

/// Of each room the place farthest from the area's border; of an area too narrow for any room, its own. None
/// of an empty area.
std::vector<glm::dvec2> roomCentres(const StandingArea& area, const RoomOptions& options = {});

}  // namespace acentric
