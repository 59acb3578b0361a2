#pragma once
/// The section "Bake quality" of the settings: presets with what each costs, a size to fit, and the settings
/// themselves.

#include "editor/panels/panel_context.h"

namespace acentric::editor {

void drawBakeSection(PanelContext& context);

/// The presets, what baking the project takes with each, and how near that comes to the truth where a sweep
/// has measured it; then a size in MB.
void drawBakePresets(PanelContext& context);

}  // namespace acentric::editor
