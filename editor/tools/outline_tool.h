#pragma once
/// Draws and changes the walkable outline: click corners on free ground to draw a loop (the first corner or
/// Enter closes it), drag free ground for a rectangle, drag a corner to move it, press on a side to put a
/// corner there, Ctrl+click a corner to take it away. Events in, changed outlines out; it changes nothing
/// itself.

#include <optional>
#include <vector>

#include "editor/tools/pointer_event.h"
#include "engine/geometry/outline.h"

namespace acentric::editor {

/// What is under the pointer.
struct OutlineHit {
  enum class Kind { nothing, corner, side };
  Kind kind = Kind::nothing;
  std::size_t loop = 0;
  std::size_t corner = 0;  ///< of a side: the one it begins at
  glm::dvec2 place{0};     ///< the corner, or the nearest point of the side
};
OutlineHit hitOutline(const Outline& outline, const glm::dvec2& point, double pixelsPerMetre);

/// A drawn loop takes the place of those that it crosses or encloses, and of their holes. Within an area it
/// is a hole, apart from all another area. Loops of fewer than three corners change nothing.
Outline withLoop(const Outline& outline, std::vector<glm::dvec2> loop);

/// The outline as it should be; while something is dragged, not yet `finished`.
struct OutlineIntent {
  Outline outline;
  bool finished = true;
};

class OutlineTool {
 public:
  /// Left button only.
  std::optional<OutlineIntent> press(const PointerEvent& event, const Outline& outline,
                                     double pixelsPerMetre);
  std::optional<OutlineIntent> move(const PointerEvent& event);
  std::optional<OutlineIntent> release(const PointerEvent& event, double pixelsPerMetre);
  /// Joins the last corner to the first.
  std::optional<OutlineIntent> close();
  /// True if something was afoot.
  bool cancel();

  bool dragging() const { return drag_.has_value(); }
  const std::vector<glm::dvec2>& corners() const { return corners_; }  ///< of the loop in hand
  /// That is being dragged, counter-clockwise; empty: none.
  std::vector<glm::dvec2> rectangle() const;

 private:
  struct Drag {
    Outline outline;  ///< with the corner in hand
    std::size_t loop, corner;
    glm::dvec2 offset;  ///< of the corner from the pointer
    bool changed;
  };
  std::vector<glm::dvec2> corners_;
  Outline outline_;            // as it was at the last press
  bool onFreeGround_ = false;  // where the button went down
  glm::dvec2 pressScreen_{0}, pressWorld_{0};
  std::optional<glm::dvec2> opposite_;  // corner of the rectangle
  std::optional<Drag> drag_;
};

}  // namespace acentric::editor
