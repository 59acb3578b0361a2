#pragma once
/// What the list of problems does: goes to where one is, and takes its way out.

#include "editor/actions/action_table.h"
#include "editor/session/problems.h"

namespace acentric::editor {

/// Selects its cells, frames them in the plan, switches what shows it on, opens the settings' section.
void showProblem(EditorState& state, const ProblemPlace& place);
/// The way out as an edit; nothing where it is an action. `scene` is the project's as it is now.
std::optional<Edit> editOf(const ProblemFix& fix, const Project& project, const Scene& scene);
}  // namespace acentric::editor
