#include "editor/actions/action_table.h"

#include <algorithm>

#include "editor/actions/menu_actions.h"

namespace acentric::editor {

std::vector<Action> makeActionTable() {
  std::vector<Action> table;
  addFileActions(table);
  addEditActions(table);
  addScene3dActions(table);
  addPlanActions(table);
  addLayoutActions(table);
  addOutlineActions(table);
  addWalkActions(table);
  addWalkViewActions(table);
  addTabActions(table);
  addPathActions(table);
  addAccuracyActions(table);
  addHelpActions(table);
  addWindowActions(table);
  return table;
}

const Action* findAction(const std::vector<Action>& table, const std::string& id) {
  const auto found =
      std::find_if(table.begin(), table.end(), [&id](const Action& action) { return action.id == id; });
  return found == table.end() ? nullptr : &*found;
}

const Action* findAction(const std::vector<Action>& table, const Shortcut& shortcut) {
  if (shortcut.key == 0) return nullptr;
  const auto found = std::find_if(table.begin(), table.end(), [&shortcut](const Action& action) {
    return action.shortcut == shortcut || action.alternative == shortcut;
  });
  return found == table.end() ? nullptr : &*found;
}

}  // namespace acentric::editor
