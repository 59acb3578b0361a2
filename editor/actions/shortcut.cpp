#include "editor/actions/shortcut.h"

#include "ui/keys.h"

namespace acentric::editor {
namespace {

std::string nameOfKey(int code) {
  namespace key = ui::key;
  switch (code) {
    case key::space:
      return "Space";
    case key::escape:
      return "Esc";
    case key::enter:
      return "Enter";
    case key::tab:
      return "Tab";
    case key::backspace:
      return "Backspace";
    case key::insert:
      return "Insert";
    case key::del:
      return "Del";
    case key::pageUp:
      return "Page Up";
    case key::pageDown:
      return "Page Down";
    case key::home:
      return "Home";
    case key::left:
      return "Left";
    case key::right:
      return "Right";
    case key::up:
      return "Up";
    case key::down:
      return "Down";
    default:
      break;
  }
  if (code >= key::f1 && code < key::f1 + 12) return "F" + std::to_string(code - key::f1 + 1);
  if (code > key::space && code < 127) return {char(code)};
  return "?";
}

}  // namespace

std::string describe(const Shortcut& shortcut) {
  if (shortcut.key == 0) return {};
  std::string text;
  if ((shortcut.modifiers & ui::modifier::control) != 0) text += "Ctrl+";
  if ((shortcut.modifiers & ui::modifier::alt) != 0) text += "Alt+";
  if ((shortcut.modifiers & ui::modifier::shift) != 0) text += "Shift+";
  return text + nameOfKey(shortcut.key);
}

}  // namespace acentric::editor
