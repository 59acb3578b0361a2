#pragma once
/// Publishing: where to, how far it is, what came of it, and the server that shows it.

#include "editor/panels/dialog_frame.h"

namespace acentric::editor {

void drawPublishDialog(PanelContext& context, const DialogKeys& keys);

}  // namespace acentric::editor
