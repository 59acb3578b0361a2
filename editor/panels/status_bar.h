#pragma once
/// One line at the bottom: what is being done, and how to use the tool in hand.

#include "editor/panels/panel_context.h"

namespace acentric::editor {

/// Its height, scaled.
float statusBarPixels();

void drawStatusBar(PanelContext& context);

}  // namespace acentric::editor
