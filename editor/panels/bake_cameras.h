#pragma once
/// The bake's cameras in baking order: state, how far, how long; of a failed one, why. Draws the rows in
/// sight only.

#include "editor/panels/panel_context.h"

namespace acentric::editor {

void drawBakeCameras(PanelContext& context);

}  // namespace acentric::editor
