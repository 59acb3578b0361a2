#pragma once
/// Do a layout's centres of projection stand free, above the floor that it is meant for, and has each region
/// a place to stand? Each finding says why, with the numbers, and the smallest move in plan that clears it.

#include <stop_token>
#include <string>
#include <vector>

#include "engine/base/task_runner.h"
#include "engine/inspect/surface_probe.h"
#include "engine/inspect/surroundings.h"
#include "engine/layout/layout.h"
#include "engine/scene/scene.h"

namespace acentric {

struct PlacementRules {
  double cameraRoom = 0.4;       ///< metres from a centre of projection to any surface, in all directions
  double floorTolerance = 0.25;  ///< metres: the floor below a centre may differ from the walk plane by this
  double wallClearance = 0.2;    ///< metres to the sides that a person needs
  double mostPush = 1;           ///< metres: how far a push-out is looked for

  Status check() const;
};

enum class PlacementFlaw : std::uint8_t {
  insideSolid,    ///< a centre: the camera sees the inside of a wall or a column
  tooNear,        ///< a centre: a surface nearer than cameraRoom
  noFloor,        ///< a centre: nothing below
  floorTooHigh,   ///< a centre: what is below it lies above the walk plane: furniture, a step
  floorTooLow,    ///< a centre: what is below it lies below the walk plane: a pit, the outside
  noStandingRoom  ///< a region: no place in it where a person could stand
};
const char* nameOf(PlacementFlaw flaw);  ///< "insideSolid"

enum class Severity : std::uint8_t { note, warning, error };
const char* nameOf(Severity severity);

struct PlacementFinding {
  PlacementFlaw flaw = PlacementFlaw::tooNear;
  Severity severity = Severity::note;
  std::vector<int> cameras;  ///< into Layout::cameras: all at this centre; empty for a region
  int region = -1;           ///< into Layout::regions; -1 for a centre
  glm::dvec2 place{0};       ///< plan, metres: the centre of projection, or the region's middle
  std::string reason;        ///< one sentence, with numbers
  /// Where the centre would stand free, by the smallest move found; nothing if none within mostPush, or none
  /// is needed (notes).
  std::optional<glm::dvec2> push;  ///< metres to move by in plan
  /// Of cameras of the lattice, no note: where a panorama would stand free in the region that they show least
  /// of; nothing if nowhere in it.
  std::optional<glm::dvec2> panorama = {};
  /// A note for this alone: hardly anything of what is seen from the regions is hidden from the cameras that
  /// are to show it (camera_sight.h).
  bool suffices = false;
};

struct PlacementReport {
  /// The worst first; then by flaw, then by place.
  std::vector<PlacementFinding> findings;
  int centres = 0;  ///< distinct centres of projection looked at
  int regions = 0;
  /// Nearly all centres seemed to be inside a solid: the scene's walls show their backs, so sides tell
  /// nothing and insideSolid was not checked.
  bool ignoredSides = false;

  int count(Severity severity) const;
};

/// `cancelled` if stopped. The probe is called from the runner's threads.
Result<PlacementReport> checkPlacement(const Layout& layout, const Bounds& bounds,
                                       const PlacementRules& rules, const SurfaceProbe& probe,
                                       TaskRunner& runner, std::stop_token stop = {});

/// Distinct centres of projection, with the cameras at each: cameras of one corner stand at the very same
/// point.
struct CameraCentre {
  glm::dvec2 position{0};
  std::vector<int> cameras;
};
std::vector<CameraCentre> centresOf(const Layout& layout);

}  // namespace acentric
