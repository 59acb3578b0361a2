#include "editor/actions/menu_actions.h"
#include "ui/translate.h"

namespace acentric::editor {

void addHelpActions(std::vector<Action>& table) {
  table.push_back({"help.commands",
                   "Help",
                   trLater("Find a command…"),
                   {key::p, kCtrlShift},
                   {key::k, kCtrl},
                   trLater("Every command by a few letters of its name, with its key"),
                   false,
                   always,
                   [](ActionContext& c) {
                     c.state.dialog = Dialog::commands;
                     ++c.state.commandsOpened;
                   },
                   {}});
  table.push_back(
      {"help.guide",
       "Help",
       trLater("Guided start"),
       {},
       {},
       trLater("Place cells, see coverage, bake, walk, save: step by step on the project that is open"),
       false,
       withBuilt,
       [](ActionContext& c) { c.state.guide.start(guideFacts(c)); },
       {}});
  table.push_back({"help.shortcuts",
                   "Help",
                   trLater("Keys and mouse"),
                   {key::f1, 0},
                   {},
                   trLater("All keys and what the mouse does, searchable"),
                   false,
                   always,
                   [](ActionContext& c) { c.state.dialog = Dialog::shortcuts; },
                   {}});
  table.push_back({"help.about",
                   "Help",
                   trLater("About Acentric"),
                   {},
                   {},
                   "",
                   false,
                   always,
                   [](ActionContext& c) { c.state.dialog = Dialog::about; },
                   {}});
}

}  // namespace acentric::editor
