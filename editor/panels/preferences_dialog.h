#pragma once
/// Everything that is remembered for all projects. Changes act at once.

#include "editor/panels/panel_context.h"

namespace acentric::editor {

/// Contents and buttons, within a dialog; true when it is to be closed.
bool drawPreferences(PanelContext& context);

}  // namespace acentric::editor
