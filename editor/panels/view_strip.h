#pragma once
/// The strip on top of a view: tabs of what may be shown there, and a button that makes it fill the window.

#include <span>

#include "editor/panels/panel_context.h"

namespace acentric::editor {

struct ViewTab {
  const char* id;  ///< of the action that shows the view
  const char* label;
};

/// `own`: the view that is shown, of `tabs`. `active`: keys go to it.
void drawViewStrip(PanelContext& context, std::span<const ViewTab> tabs, const char* own, bool active);

}  // namespace acentric::editor
