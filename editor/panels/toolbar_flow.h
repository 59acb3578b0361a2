#pragma once
/// Buttons of a toolbar, which goes on in the next line where a panel is too narrow for it.

#include "editor/panels/panel_context.h"

namespace acentric::editor {

/// Before a button, unscaled pixels.
inline constexpr float kNear = 3, kApart = 16;

struct ToolbarEntry {
  const char* id;  ///< of an action; nullptr: what the panel draws itself
  const char* label;
  float gap;
  ButtonLook look = ButtonLook::toggle;
};

/// The next item, `width` pixels wide, comes on this line if there is room for it, else on the next.
void flow(float width, float gap);
/// The same for a button with this label.
void flowButton(const char* label, float gap);

}  // namespace acentric::editor
