#pragma once
/// Sections of the settings, and the parts of them that few need.

#include <string>
#include <vector>

#include "editor/panels/panel_context.h"

namespace acentric::editor {

/// A section that other parts of the window may ask to be opened (EditorState::openSection).
bool askedSection(PanelContext& context, const char* label, bool openAtFirst = true);

/// "Advanced" within a section, closed at first; asked for as SECTION/Advanced. True while it is open: its
/// fields follow. `changed`: those of its settings that are not as usual; how many is told where they are
/// hidden.
bool advancedPart(PanelContext& context, const char* section, const std::vector<std::string>& changed);

}  // namespace acentric::editor
