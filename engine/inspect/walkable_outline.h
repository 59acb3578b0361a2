#pragma once
/// Where a person can stand and walk: found by casting rays on a grid. The designer may edit the result.
///
/// Floor is what faces upwards, has the head room, and is not inside a solid. Outside and inside are told by
/// the sides that surfaces show, as they are wound. A scene whose walls all show their backs to the room (a
/// shell made to be seen from outside) is then a solid, and nothing is floor in it: only if there is no other
/// floor at all, or only the outside of such a shell with floor in it, sides are ignored.
///
/// Of several heights and parts, the floor is chosen on which most is enclosed: surfaces at eye height in
/// more than half of the directions, those farther than 20 m counting less, up to 100 m. So rooms, halls,
/// streets and squares win over the ground around a building. Open ground counts a hundredth, and wins where
/// it is vast or where nothing is enclosed. A hut does not win over the ground at its own height.

#include <limits>

#include "engine/base/result.h"
#include "engine/geometry/outline.h"
#include "engine/inspect/floor_levels.h"
#include "engine/inspect/standing.h"

namespace acentric {

class TaskRunner;

struct WalkableOptions {
  double eyeHeight = 1.6;        ///< metres of head room needed = eyeHeight + 0.15
  double floorTolerance = 0.25;  ///< metres: floors within this of the chosen height count
  double stepHeight = 0.25;      ///< metres: what a foot climbs at once, on the way from place to place
  double wallClearance = 0.2;    ///< metres from obstacles
  double gridStep = 0;           ///< metres; 0 = from the scene's size (about 200 x 200 points)
  double floorHeight = std::numeric_limits<double>::quiet_NaN();  ///< NaN = chosen: see above
  bool ignoreSides = false;  ///< every surface may be floor, and nothing is the inside of a solid
  /// Looks around at many places at a time; null: at one after the other. Finds the same.
  TaskRunner* runner = nullptr;

  Status check() const;
  double headRoom() const;  ///< metres
  StandingRules standingRules() const;
};

struct WalkableArea {
  double floorHeight = 0;
  Outline outline;  ///< one connected area, simplified to about one grid step
  bool ignoredSides = false;
};

Result<WalkableArea> findWalkableArea(const Bounds& bounds, const WalkableOptions& options,
                                      const SurfaceProbe& probe);

/// The grid that `options` asks for over the plan of a scene.
Result<ProbeGrid> layProbeGrid(const Bounds& bounds, const WalkableOptions& options);

}  // namespace acentric
