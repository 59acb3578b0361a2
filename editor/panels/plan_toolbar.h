#pragma once
/// The buttons above the plan: tools, what is shown, and the tool's own row.

#include "editor/panels/panel_context.h"

namespace acentric::editor {

void drawPlanToolbar(PanelContext& context);
/// What the tool that paints density paints, where that is in hand.
void drawDensityRow(PanelContext& context);

}  // namespace acentric::editor
