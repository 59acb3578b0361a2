#pragma once
/// What the plan's tools ask for, done: the same from the plan and from the floor of the 3D view.

#include "editor/actions/action.h"

namespace acentric::editor {

/// All but pans, which are the view's.
void takePlanIntent(ActionContext& c, const PlanIntent& intent);
/// Nothing where a place is taken: that is told.
void moveSelected(ActionContext& c, const std::set<CellId>& cells, const LatticeStep& step);

}  // namespace acentric::editor
