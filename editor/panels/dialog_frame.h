#pragma once
/// What all modal dialogs look like.

#include "editor/panels/panel_context.h"

namespace acentric::editor {

/// Pressed this frame, while a dialog is open.
struct DialogKeys {
  bool enter = false;
  bool escape = false;
};

/// Of a dialog's buttons, scaled.
float dialogButtonWidth();
/// A modal in the middle of the window, `width` unscaled; call endDialog() if true. `title`: English, which
/// is also its id.
bool beginDialog(const char* title, float width);
void endDialog(bool close);
/// So many buttons, of `width` (0 = the usual one), stand at the lower right.
void alignButtons(int buttons, float width = 0);

}  // namespace acentric::editor
