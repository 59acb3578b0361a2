#pragma once
/// The log: everything that was said, newest at the bottom, copied by a click.

#include "editor/panels/panel_context.h"

namespace acentric::editor {

ui::Colour colourOf(MessageLevel level);
void drawMessagesPanel(PanelContext& context);

}  // namespace acentric::editor
