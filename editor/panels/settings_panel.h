#pragma once
/// All settings of the project, by topic, with what each trades.

#include "editor/panels/configuration_picker.h"
#include "editor/panels/panel_context.h"

namespace acentric::editor {

void drawSettingsPanel(PanelContext& context, ConfigurationPicker& configurations);

/// Which storey is shown and edited.
void drawStoreyChoice(PanelContext& context);

/// The effect plan: what the scene calls for, with reasons and overrides. A section of the settings.
void drawEffects(PanelContext& context);

}  // namespace acentric::editor
