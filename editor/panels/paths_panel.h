#pragma once
/// Bookmarks and paths: the list, recording, replay, and what is selected.

#include "editor/panels/panel_context.h"

namespace acentric::editor {

void drawPathsPanel(PanelContext& context);

}  // namespace acentric::editor
