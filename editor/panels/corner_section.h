#pragma once
/// Exact values of the corner of the outline that is selected in the 3D view.

#include "editor/panels/panel_context.h"

namespace acentric::editor {

void drawCornerSection(PanelContext& context, float labelWidth);

}  // namespace acentric::editor
