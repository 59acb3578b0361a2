#pragma once
/// Keys, buttons and the wheel in the order in which they happened. ImGui 1.86 polls their state once a
/// frame, so that a slow frame loses short presses and misplaces drags; this queue is filled by the window
/// system's callbacks. Positions are window coordinates in pixels, y down. Codes and modifier bits are
/// GLFW's.

#include <glm/glm.hpp>
#include <set>
#include <vector>

namespace acentric::ui {

struct InputEvent {
  enum class Kind { keyPress, keyRepeat, keyRelease, buttonPress, buttonRelease, move, scroll };
  Kind kind = Kind::move;
  int code = 0;            ///< key or mouse button
  int modifiers = 0;       ///< GLFW_MOD_*
  glm::dvec2 position{0};  ///< of the pointer at that moment
  glm::dvec2 scroll{0};
  double seconds = 0;  ///< when it was received
};

class InputQueue {
 public:
  /// Moves that follow one another are merged.
  void push(const InputEvent& event);
  /// What happened since the last call, oldest first.
  std::vector<InputEvent> take();
  /// The last of what take() gave, to be given again.
  void putBack(const std::vector<InputEvent>& events);
  /// What take() would give.
  const std::vector<InputEvent>& pending() const { return events_; }
  bool empty() const { return events_.empty(); }

  const glm::dvec2& pointer() const { return pointer_; }
  bool keyHeld(int key) const { return held_.contains(key); }
  int modifiers() const { return modifiers_; }
  /// The window lost the focus: releases of held keys would never arrive.
  void releaseAll(double seconds);

 private:
  std::vector<InputEvent> events_;
  std::set<int> held_;
  std::set<int> heldButtons_;
  glm::dvec2 pointer_{0};
  int modifiers_ = 0;
};

}  // namespace acentric::ui
