#pragma once
/// What the list of problems does: goes to where one is, and takes its way out.

#include "editor/actions/action_table.h"
#include "editor/session/problems.h"

namespace acentric::editor {

/// Selects its cells, frames them in the plan, switches what shows it on, opens the settings' section.
void showProblem(EditorState& state, const ProblemPlace& place);
/// A move in plan as an edit.
Edit pushOut(const Project& project, const ProblemFix& fix);
/// The model at the scale that `fix` states, the layout with it. `scene` is the project's as it is now.
Edit changeScale(const Project& project, const Scene& scene, const ProblemFix& fix);
}  // namespace acentric::editor
