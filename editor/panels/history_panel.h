#pragma once
/// The list of edits, oldest at the top; a click goes back or forth to one.

#include "editor/panels/panel_context.h"

namespace acentric::editor {

void drawHistoryPanel(PanelContext& context);

}  // namespace acentric::editor
