#pragma once
/// How the walk is drawn and walked: the home of all its settings, as a button of the walk's toolbar with a
/// pop-over.

#include "editor/panels/toolbar_flow.h"

namespace acentric::editor {

/// `glProblem`: why OpenGL renderers cannot be chosen; empty if they can.
void drawWalkSettingsButton(PanelContext& context, const ToolbarEntry& entry, const std::string& glProblem);

}  // namespace acentric::editor
