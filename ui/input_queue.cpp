#include "ui/input_queue.h"

#include "ui/keys.h"

namespace acentric::ui {
namespace {

/// X11 tells of a modifier's own key what was held before it.
int modifiersAfter(const InputEvent& event) {
  if (event.kind == InputEvent::Kind::buttonPress || event.kind == InputEvent::Kind::buttonRelease)
    return event.modifiers;
  const int own = key::modifierOf(event.code);
  return event.kind == InputEvent::Kind::keyRelease ? event.modifiers & ~own : event.modifiers | own;
}

}  // namespace

void InputQueue::push(const InputEvent& event) {
  using Kind = InputEvent::Kind;
  switch (event.kind) {
    case Kind::keyPress:
    case Kind::keyRepeat:
      held_.insert(event.code);
      break;
    case Kind::keyRelease:
      held_.erase(event.code);
      break;
    case Kind::buttonPress:
      heldButtons_.insert(event.code);
      break;
    case Kind::buttonRelease:
      heldButtons_.erase(event.code);
      break;
    case Kind::move:
    case Kind::scroll:
      break;
  }
  if (event.kind != Kind::scroll && event.kind != Kind::move) modifiers_ = modifiersAfter(event);
  if (event.kind == Kind::move) pointer_ = event.position;
  if (event.kind == Kind::move && !events_.empty() && events_.back().kind == Kind::move) {
    events_.back() = event;
    return;
  }
  events_.push_back(event);
}

std::vector<InputEvent> InputQueue::take() {
  std::vector<InputEvent> taken;
  taken.swap(events_);
  return taken;
}

void InputQueue::putBack(const std::vector<InputEvent>& events) {
  events_.insert(events_.begin(), events.begin(), events.end());
}

void InputQueue::releaseAll(double seconds) {
  const auto release = [&](InputEvent::Kind kind, const std::set<int>& codes) {
    for (const int code : codes) events_.push_back({kind, code, 0, pointer_, {}, seconds});
  };
  release(InputEvent::Kind::keyRelease, held_);
  release(InputEvent::Kind::buttonRelease, heldButtons_);
  held_.clear();
  heldButtons_.clear();
  modifiers_ = 0;
}

}  // namespace acentric::ui
