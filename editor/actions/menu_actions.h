#pragma once
/// The actions by menu; makeActionTable() puts them in order. Each appends to the table.

#include <vector>

#include "editor/actions/action.h"
#include "ui/keys.h"

namespace acentric::editor {

namespace key = ui::key;
inline constexpr int kCtrl = ui::modifier::control;
inline constexpr int kCtrlShift = ui::modifier::control | ui::modifier::shift;

// When an action makes sense.
inline bool always(const ActionContext&) { return true; }
inline bool withProject(const ActionContext& c) { return c.session.hasProject(); }
inline bool withBuilt(const ActionContext& c) {
  return c.session.hasProject() && c.session.built() != nullptr;
}

void addFileActions(std::vector<Action>& table);
void addEditActions(std::vector<Action>& table);
/// Tools and what the plan shows.
void addPlanActions(std::vector<Action>& table);
/// Storeys, and cells that keep to the triangle budget.
void addLayoutActions(std::vector<Action>& table);
void addWalkActions(std::vector<Action>& table);
void addHelpActions(std::vector<Action>& table);

}  // namespace acentric::editor
