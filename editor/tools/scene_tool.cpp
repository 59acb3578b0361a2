#include "editor/tools/scene_tool.h"

#include "editor/tools/pointer_event.h"
#include "ui/keys.h"

namespace acentric::editor {

SceneIntent SceneTool::handle(const ScenePointer& event, bool picking) {
  switch (event.kind) {
    case ScenePointer::Kind::press:
      return press(event);
    case ScenePointer::Kind::move:
      return move(event);
    case ScenePointer::Kind::release:
      return release(event, picking);
  }
  return {};
}

SceneIntent SceneTool::press(const ScenePointer& event) {
  if (state_ != State::rest) return {};  // a second button during a drag changes nothing
  button_ = event.button;
  pressed_ = last_ = event.pixel;
  state_ = event.button == ui::mouse::left ? State::pressed : State::pan;
  if (state_ == State::pan) return HoldIntent{event.pixel};
  return {};
}

SceneIntent SceneTool::move(const ScenePointer& event) {
  if (state_ == State::pressed && glm::distance(event.pixel, pressed_) >= kDragPixels) {
    state_ = State::orbit;
    last_ = pressed_;
  }
  const glm::dvec2 moved = event.pixel - last_;
  if (state_ == State::orbit || state_ == State::pan) last_ = event.pixel;
  if (state_ == State::orbit) return OrbitIntent{moved};
  if (state_ == State::pan) return PanViewIntent{moved};
  return {};
}

SceneIntent SceneTool::release(const ScenePointer& event, bool picking) {
  if (state_ == State::rest || event.button != button_) return {};
  const bool click = state_ == State::pressed;
  state_ = State::rest;
  if (!click) return {};
  if (picking || (event.modifiers & ui::modifier::alt) != 0) return PickAtIntent{event.pixel};
  const bool second =
      event.seconds - clickedAt_ <= kDoubleClickSeconds && glm::distance(event.pixel, clicked_) < kDragPixels;
  clickedAt_ = second ? -1e9 : event.seconds;  // a third click begins anew
  clicked_ = event.pixel;
  if (second) return OpenAtIntent{event.pixel};
  const bool adds = (event.modifiers & ui::modifier::shift) != 0;
  const bool toggles = (event.modifiers & ui::modifier::control) != 0;
  return SelectAtIntent{event.pixel, toggles ? Combine::toggle : adds ? Combine::add : Combine::replace};
}

}  // namespace acentric::editor
