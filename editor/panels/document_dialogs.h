#pragma once
/// Questions about the project as a document: a new one, one that others have open or have changed, and a
/// model that is gone or lies elsewhere.

#include "editor/panels/dialog_frame.h"
#include "editor/panels/panel_context.h"

namespace acentric::editor {

void drawNewProject(PanelContext& context, const DialogKeys& keys);
void drawLockQuestion(PanelContext& context, const DialogKeys& keys);
void drawChangedOnDisk(PanelContext& context, const DialogKeys& keys);
void drawMissingModel(PanelContext& context, const DialogKeys& keys);
void drawOutsideModel(PanelContext& context, const DialogKeys& keys);

}  // namespace acentric::editor
