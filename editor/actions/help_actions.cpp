#include "editor/actions/menu_actions.h"

namespace acentric::editor {

void addHelpActions(std::vector<Action>& table) {
  table.push_back({"help.commands",
                   "Help",
                   "Find a command…",
                   {key::p, kCtrlShift},
                   {key::k, kCtrl},
                   "Every command by a few letters of its name, with its key",
                   false,
                   always,
                   [](ActionContext& c) {
                     c.state.dialog = Dialog::commands;
                     ++c.state.commandsOpened;
                   },
                   {}});
  table.push_back({"help.guide",
                   "Help",
                   "Guided start",
                   {},
                   {},
                   "Place cells, see coverage, bake, walk, save: step by step on the project that is open",
                   false,
                   withBuilt,
                   [](ActionContext& c) { c.state.guide.start(guideFacts(c)); },
                   {}});
  table.push_back({"help.shortcuts",
                   "Help",
                   "Keys and mouse",
                   {key::f1, 0},
                   {},
                   "All keys and what the mouse does, searchable",
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
