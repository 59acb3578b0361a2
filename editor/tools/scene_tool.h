#pragma once
/// What the pointer does in the 3D view, as a state machine: events in, intentions out. It changes nothing
/// itself.
///   left drag orbits; right or middle drag pans
///   click selects (Shift: adds to the selection, Ctrl: adds or takes off); Alt+click, or a click while the
///   pick tool is on, picks the surface double click centres on a surface or opens a camera

#include <glm/glm.hpp>
#include <variant>

#include "editor/commands/selection.h"

namespace acentric::editor {

struct ScenePointer {
  enum class Kind { press, move, release };
  Kind kind = Kind::move;
  int button = 0;
  int modifiers = 0;
  glm::dvec2 pixel{0};  ///< of the picture
  double seconds = 0;   ///< monotonic
};

struct OrbitIntent {
  glm::dvec2 pixels{0};
};
/// Take hold of what lies under the pixel, for the pans that follow.
struct HoldIntent {
  glm::dvec2 pixel{0};
};
struct PanViewIntent {
  glm::dvec2 pixels{0};
};
struct SelectAtIntent {
  glm::dvec2 pixel{0};
  Combine how = Combine::replace;
};
struct PickAtIntent {
  glm::dvec2 pixel{0};
};
struct OpenAtIntent {
  glm::dvec2 pixel{0};
};
using SceneIntent = std::variant<std::monostate, OrbitIntent, HoldIntent, PanViewIntent, SelectAtIntent,
                                 PickAtIntent, OpenAtIntent>;

class SceneTool {
 public:
  static constexpr double kDoubleClickSeconds = 0.45;

  SceneIntent handle(const ScenePointer& event, bool picking);
  /// A button is down: events belong to the view wherever the pointer is.
  bool capturing() const { return state_ != State::rest; }
  bool dragging() const { return state_ == State::orbit || state_ == State::pan; }
  void cancel() { state_ = State::rest; }

 private:
  enum class State { rest, pressed, orbit, pan };
  SceneIntent press(const ScenePointer& event);
  SceneIntent move(const ScenePointer& event);
  SceneIntent release(const ScenePointer& event, bool picking);

  State state_ = State::rest;
  int button_ = 0;
  glm::dvec2 pressed_{0}, last_{0};
  glm::dvec2 clicked_{-1e9};
  double clickedAt_ = -1e9;
};

}  // namespace acentric::editor
