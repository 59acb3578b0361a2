#pragma once
/// How many copies of the selection are laid along the lattice, over the plan that shows where they go.

#include "editor/panels/panel_context.h"

namespace acentric::editor {

/// At a place of the window, pixels; while an array is being laid out. `places`, `taken`: of the copies.
/// Returns the corner that it ends at.
ImVec2 drawArrayPanel(PanelContext& context, const ImVec2& at, int places, int taken);

}  // namespace acentric::editor
