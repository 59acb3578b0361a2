#pragma once
/// The menus, made from the table of actions.

#include "editor/panels/panel_context.h"

namespace acentric::editor {

/// Returns its height in pixels.
float drawMenuBar(PanelContext& context);

}  // namespace acentric::editor
