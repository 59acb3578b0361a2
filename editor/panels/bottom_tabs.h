#pragma once
/// The pane at the lower right: one of several lists at a time.

#include "editor/panels/panel_context.h"

namespace acentric::editor {

void drawBottomTabs(PanelContext& context);

}  // namespace acentric::editor
