#pragma once
/// What is known of the walk that is open, in place of the settings that only a project has.

#include "editor/panels/panel_context.h"

namespace acentric::editor {

/// Name, size and maker in one line.
std::string walkLine(const ShippedWalk& walk);

void drawWalkFacts(PanelContext& context);

}  // namespace acentric::editor
