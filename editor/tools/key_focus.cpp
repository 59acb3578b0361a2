#include "editor/tools/key_focus.h"

#include <utility>

#include "ui/keys.h"

namespace acentric::editor {

void KeyFocus::handle(const ui::InputEvent& event, bool popupOpen) {
  using Kind = ui::InputEvent::Kind;
  namespace key = ui::key;
  const bool alt = event.code == key::leftAlt || event.code == key::rightAlt;
  if (event.kind == Kind::keyRelease && alt) {
    altTapped_ = altTapped_ || (altAlone_ && !popupOpen);
    altAlone_ = false;
  }
  if (event.kind == Kind::keyPress) {
    altAlone_ = alt;
    if (event.code == key::tab && (event.modifiers & (ui::modifier::control | ui::modifier::alt)) == 0)
      onWidgets_ = true;
    if (event.code == key::escape && !popupOpen) onWidgets_ = false;
  }
  if (event.kind == Kind::buttonPress) {
    altAlone_ = false;
    onWidgets_ = false;
  }
}

bool KeyFocus::takeAltTap() { return std::exchange(altTapped_, false); }

}  // namespace acentric::editor
