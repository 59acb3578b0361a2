#include "editor/actions/menu_actions.h"

namespace acentric::editor {

void addHelpActions(std::vector<Action>& table) {
  table.push_back({"help.shortcuts",
                   "Help",
                   "Keys and mouse",
                   {key::f1, 0},
                   {},
                   "",
                   false,
                   always,
                   [](ActionContext& c) { c.state.dialog = Dialog::shortcuts; },
                   {}});
  table.push_back({"help.about",
                   "Help",
                   "About Acentric",
                   {},
                   {},
                   "",
                   false,
                   always,
                   [](ActionContext& c) { c.state.dialog = Dialog::about; },
                   {}});
}

}  // namespace acentric::editor
