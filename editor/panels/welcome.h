#pragma once
/// What is shown while no project is open: how to begin, and what was open before.

#include "editor/panels/panel_context.h"

namespace acentric::editor {

void drawWelcome(PanelContext& context);

}  // namespace acentric::editor
