#pragma once
/// A pointer event in the plan, in pixels and in metres.

#include <glm/glm.hpp>

namespace acentric::editor {

struct PointerEvent {
  enum class Kind { press, move, release };
  Kind kind = Kind::move;
  int button = 0;
  int modifiers = 0;
  glm::dvec2 screen{0};
  glm::dvec2 world{0};
};

inline constexpr double kDragPixels = 5;   ///< less is a click
inline constexpr double kGrabPixels = 11;  ///< how near to a handle a press takes hold of it

}  // namespace acentric::editor
