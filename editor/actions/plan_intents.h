#pragma once
/// What the plan's tools ask for, done: the same from the plan and from the floor of the 3D view.

#include "editor/actions/action.h"

namespace acentric::editor {

/// All but pans, which are the view's.
void takePlanIntent(ActionContext& c, const PlanIntent& intent);
/// A button went down in a view: the plan's tools follow its pointer from now on. False while they follow
/// another view's; with the left button what they had in hand there is stale, and is given up.
bool takeOver(ActionContext& c, View view, int button);
/// Nothing where a place is taken: that is told.
void moveSelected(ActionContext& c, const std::set<CellId>& cells, const LatticeStep& step);

}  // namespace acentric::editor
