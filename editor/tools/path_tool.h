#pragma once
/// Changes paths on the plan: click a key pose to select it, drag it to move it, drag the end of its tick to
/// turn its view, press on the line of the selected path to put a key pose there, Shift+press on free
/// ground for one at its end, Ctrl+click takes one away; click another path to select that. Events in,
/// changed paths out; it changes nothing itself.

#include <span>

#include "editor/tools/pointer_event.h"
#include "editor/tools/walk_selection.h"

namespace acentric::editor {

/// What the tool needs to know of the project at the moment of an event.
struct PathSituation {
  std::span<const WalkPath> paths;
  int storey = 0;  ///< only its paths are there
  WalkSelection selection;
};

inline constexpr double kTickPixels = 26;  ///< from the selected key pose to where its view is turned

/// What is under the pointer.
struct PathHit {
  enum class Kind { nothing, pose, tick, line };
  Kind kind = Kind::nothing;
  std::size_t path = 0;
  std::size_t pose = 0;  ///< of a line: the one it begins at
  double seconds = 0;    ///< of the nearest point of a line
  glm::dvec2 place{0};
};
/// Ticks are of the selected key pose alone, and come first; then key poses, then lines; of those equally
/// near the selected path's.
PathHit hitPaths(const PathSituation& situation, const glm::dvec2& point, double pixelsPerMetre);

/// A path is to be selected, and a key pose of it or none; `changed`: and to be so. While something is
/// dragged, not yet `finished`.
struct PathIntent {
  std::optional<std::size_t> path;
  std::optional<std::size_t> pose;
  std::optional<CameraPath> changed;
  bool finished = true;
};

class PathTool {
 public:
  /// Left button only. Nothing: the press is on free ground.
  std::optional<PathIntent> press(const PointerEvent& event, const PathSituation& situation,
                                  double pixelsPerMetre);
  std::optional<PathIntent> move(const PointerEvent& event);
  std::optional<PathIntent> release(const PointerEvent& event);
  /// True if something was afoot.
  bool cancel();

 private:
  struct Drag {
    std::size_t path, pose;
    CameraPath changed;
    glm::dvec2 offset;  ///< of the pose from the pointer
    bool turning;
    bool moved;
  };
  PathIntent changedTo(bool finished) const;
  std::optional<PathIntent> append(const PointerEvent& event, const PathSituation& situation);
  std::optional<Drag> drag_;
  glm::dvec2 pressScreen_{0};
};

}  // namespace acentric::editor
