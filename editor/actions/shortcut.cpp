#include "editor/actions/shortcut.h"

#include "ui/keys.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

std::string nameOfKey(int code) {
  namespace key = ui::key;
  switch (code) {
    case key::space:
      return trIn("key", "Space");
    case key::escape:
      return trIn("key", "Esc");
    case key::enter:
      return trIn("key", "Enter");
    case key::tab:
      return trIn("key", "Tab");
    case key::backspace:
      return trIn("key", "Backspace");
    case key::insert:
      return trIn("key", "Insert");
    case key::del:
      return trIn("key", "Del");
    case key::pageUp:
      return trIn("key", "Page Up");
    case key::pageDown:
      return trIn("key", "Page Down");
    case key::home:
      return trIn("key", "Home");
    case key::left:
      return trIn("key", "Left");
    case key::right:
      return trIn("key", "Right");
    case key::up:
      return trIn("key", "Up");
    case key::down:
      return trIn("key", "Down");
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
  if ((shortcut.modifiers & ui::modifier::control) != 0) text += trIn("key", "Ctrl") + std::string("+");
  if ((shortcut.modifiers & ui::modifier::alt) != 0) text += trIn("key", "Alt") + std::string("+");
  if ((shortcut.modifiers & ui::modifier::shift) != 0) text += trIn("key", "Shift") + std::string("+");
  return text + nameOfKey(shortcut.key);
}

}  // namespace acentric::editor
