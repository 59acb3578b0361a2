#pragma once
/// What import found, dropped, ignored and guessed.

#include "editor/panels/panel_context.h"

namespace acentric::editor {

void drawReportPanel(PanelContext& context);

}  // namespace acentric::editor
