#pragma once
/// Preferences that panels show beside what they bear on; the preferences dialog shows the same fields. Each
/// is saved when its edit is over.

#include "editor/panels/panel_context.h"

namespace acentric::editor {

void bakeThreadsField(PanelContext& context, float labelWidth);
void bakeMemoryField(PanelContext& context, float labelWidth);
void walkMemoryField(PanelContext& context, float labelWidth);
void walkSpeedField(PanelContext& context, float labelWidth);

}  // namespace acentric::editor
