#pragma once
/// Lays the lattice by handles: the middle one moves it, the one on the circle turns it, the one at a ring's
/// corner makes its cells larger or smaller, about the ring that the handles are at. With Shift they snap:
/// to corners of the scene or the grid, to 15 degrees or the walls, to round sizes. Events in, intentions
/// out.

#include <optional>
#include <string>

#include "editor/commands/layout_edits.h"
#include "editor/tools/pointer_event.h"
#include "editor/tools/snap.h"

namespace acentric::editor {

enum class LatticeGrip { none, origin, turn, size };

/// Plan, metres.
struct LatticeHandles {
  glm::dvec2 centre{
      0};  ///< of the lattice's origin, or where that is off the view, of the ring in its middle
  glm::dvec2 turn{0};
  glm::dvec2 size{0};
  LatticeGrip gripAt(const glm::dvec2& point, double pixelsPerMetre) const;
};
LatticeHandles latticeHandles(const LayoutSpec& spec, const glm::dvec2& viewLow, const glm::dvec2& viewHigh,
                              double pixelsPerMetre);

struct LatticeIntent {
  LatticePlace place;
  LatticeGrip grip = LatticeGrip::none;
};

class LatticeTool {
 public:
  /// Left button only. False on free ground: the press is not the tool's.
  bool press(const PointerEvent& event, const LayoutSpec& spec, const LatticeHandles& handles,
             double pixelsPerMetre);
  void move(const PointerEvent& event, const SnapTargets& targets, double pixelsPerMetre);
  /// Nothing if it is as it was.
  std::optional<LatticeIntent> release(const PointerEvent& event, const SnapTargets& targets,
                                       double pixelsPerMetre);
  /// True if something was afoot.
  bool cancel();

  bool dragging() const { return grip_ != LatticeGrip::none; }
  LatticeGrip grip() const { return grip_; }
  /// As it would be now, while it is dragged.
  const LatticePlace& place() const { return place_; }
  /// Where the handle in hand is now, and what to write beside it.
  const glm::dvec2& hand() const { return hand_; }
  std::string text() const;
  /// What the history calls it.
  static std::string labelOf(const LatticeIntent& intent);

 private:
  LatticeGrip grip_ = LatticeGrip::none;
  LatticePlace before_, place_;
  glm::dvec2 centre_{0}, grabbed_{0}, hand_{0};
};

}  // namespace acentric::editor
