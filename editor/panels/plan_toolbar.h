#pragma once
/// The buttons above the plan: tools, what is shown, and the tool's own row.

#include "editor/panels/panel_context.h"

namespace acentric::editor {

void drawPlanToolbar(PanelContext& context);
/// Those of the tools that work in the 3D view as they do on the plan: all but the one for cells.
void drawPlanTools(PanelContext& context);
/// What the tool that paints density paints, where that is in hand.
void drawDensityRow(PanelContext& context);

}  // namespace acentric::editor
