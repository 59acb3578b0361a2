#include "editor/actions/menu_actions.h"

namespace acentric::editor {

void addFileActions(std::vector<Action>& table) {
  table.push_back({"file.open",
                   "File",
                   "Open…",
                   {key::o, kCtrl},
                   {},
                   "A project, or a model for a new project",
                   false,
                   always,
                   [](ActionContext& c) {
                     proceedAfterAsking(c, {Continuation::Kind::openDialog, {}});
                   },
                   {}});
  table.push_back({"file.save",
                   "File",
                   "Save",
                   {key::s, kCtrl},
                   {},
                   "Save the project",
                   true,
                   [](const ActionContext& c) { return c.session.dirty(); },
                   [](ActionContext& c) { saveThen(c, {}); },
                   {}});
  table.push_back({"file.saveAs",
                   "File",
                   "Save as…",
                   {key::s, kCtrlShift},
                   {},
                   "Save under another name; captures go along",
                   false,
                   withProject,
                   [](ActionContext& c) {
                     c.state.continuation = {};
                     c.state.dialog = Dialog::saveAs;
                   },
                   {}});
  table.push_back({"file.close",
                   "File",
                   "Close project",
                   {key::w, kCtrl},
                   {},
                   "",
                   false,
                   withProject,
                   [](ActionContext& c) {
                     proceedAfterAsking(c, {Continuation::Kind::close, {}});
                   },
                   {}});
  table.push_back({"file.quit",
                   "File",
                   "Quit",
                   {key::q, kCtrl},
                   {},
                   "",
                   true,
                   always,
                   [](ActionContext& c) {
                     proceedAfterAsking(c, {Continuation::Kind::quit, {}});
                   },
                   {}});
}

}  // namespace acentric::editor
