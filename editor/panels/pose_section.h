#pragma once
/// The key pose that is selected on the plan, in numbers.

#include "editor/panels/panel_context.h"

namespace acentric::editor {

void drawPoseSection(PanelContext& context, float labelWidth);

}  // namespace acentric::editor
