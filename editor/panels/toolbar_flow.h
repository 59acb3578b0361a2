#pragma once
/// Buttons of a toolbar, which goes on in the next line where a panel is too narrow for it.

#include <functional>
#include <span>

#include "editor/panels/panel_context.h"

namespace acentric::editor {

/// Before a button, unscaled pixels.
inline constexpr float kNear = 3, kApart = 16;

struct ToolbarEntry {
  const char* id;    ///< of an action; nullptr: what the panel draws itself
  const char* word;  ///< where the machine has no icons
  ui::Icon icon;
  float gap;
  ButtonLook look = ButtonLook::toggle;
};

/// While it lives, other widgets are as tall as icons, where there are any.
class AsTallAsIcons {
 public:
  explicit AsTallAsIcons(PanelContext& context);
  ~AsTallAsIcons();
  AsTallAsIcons(const AsTallAsIcons&) = delete;
  AsTallAsIcons& operator=(const AsTallAsIcons&) = delete;
};

/// The next item, `width` pixels wide, comes on this line if there is room for it, else on the next. Groups,
/// which are kApart, have a thin line between them.
void flow(float width, float gap);
/// The same for an entry's button.
void flowEntry(PanelContext& context, const ToolbarEntry& entry);
/// Each in turn; `own` draws those without an action.
void toolbar(PanelContext& context, std::span<const ToolbarEntry> entries,
             const std::function<void(const ToolbarEntry&)>& own = {});

}  // namespace acentric::editor
