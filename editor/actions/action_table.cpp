#include "editor/actions/action_table.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "editor/actions/menu_actions.h"

namespace acentric::editor {

namespace {

/// What can be done with a walk too; "x." stands for all that begin so. All others need a project.
constexpr std::array<std::string_view, 36> kOfWalks{"file.new",
                                                    "file.open",
                                                    "file.reimportAutomatically",
                                                    "file.close",
                                                    "file.preferences",
                                                    "file.quit",
                                                    "edit.undo",
                                                    "edit.redo",
                                                    "overlay.bake",
                                                    "overlay.bytes",
                                                    "overlay.none",
                                                    "tool.eye",
                                                    "tool.measure",
                                                    "view.plan",
                                                    "view.walk",
                                                    "view.cameras",
                                                    "view.fit",
                                                    "view.paths",
                                                    "storey.up",
                                                    "storey.down",
                                                    "view.holes",
                                                    "view.sources",
                                                    "view.minimap",
                                                    "view.images",
                                                    "view.frameTimes",
                                                    "walk.screenshot",
                                                    "walk.restart",
                                                    "path.play",
                                                    "path.stop",
                                                    "path.loop",
                                                    "bookmark.go",
                                                    "help.commands",
                                                    "help.shortcuts",
                                                    "help.about",
                                                    "tab.",
                                                    "window."};

bool ofWalks(const std::string& id) {
  return std::ranges::any_of(kOfWalks, [&id](std::string_view known) {
    return known.ends_with('.') ? id.starts_with(known) : id == known;
  });
}

/// Refuses them while a walk is open, and shows none as switched on.
void keepToProjects(std::vector<Action>& table) {
  for (Action& action : table) {
    if (ofWalks(action.id)) continue;
    action.needsProject = true;
    action.enabled = [enabled = std::move(action.enabled)](const ActionContext& c) {
      return !c.session.shippedWalk() && enabled(c);
    };
    if (action.checked)
      action.checked = [checked = std::move(action.checked)](const ActionContext& c) {
        return !c.session.shippedWalk() && checked(c);
      };
  }
}

}  // namespace

std::vector<Action> makeActionTable() {
  std::vector<Action> table;
  addFileActions(table);
  addEditActions(table);
  addArrangementActions(table);
  addScene3dActions(table);
  addPlanActions(table);
  addLayoutActions(table);
  addOutlineActions(table);
  addWalkActions(table);
  addHereActions(table);
  addQualityActions(table);
  addWalkViewActions(table);
  addTabActions(table);
  addPathActions(table);
  addAccuracyActions(table);
  addHelpActions(table);
  addWindowActions(table);
  keepToProjects(table);
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
