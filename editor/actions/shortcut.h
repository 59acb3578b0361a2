#pragma once
/// A key with modifiers, and its name for people.

#include <string>

namespace acentric::editor {

struct Shortcut {
  int key = 0;  ///< ui/keys.h; 0 = none
  int modifiers = 0;
  bool operator==(const Shortcut&) const = default;
};

/// "Ctrl+Shift+S", "Del", "1"; empty for none.
std::string describe(const Shortcut& shortcut);

}  // namespace acentric::editor
