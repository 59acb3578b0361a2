#include "editor/actions/menu_actions.h"
#include "ui/translate.h"

namespace acentric::editor {

namespace {

/// On the model that the project is made of, and on the project's own file as others leave it.
void addOutsideActions(std::vector<Action>& table) {
  table.push_back({"file.reimport",
                   "File",
                   trLater("Import the model again"),
                   {key::f5, 0},
                   {},
                   trLater("Reads the model and its textures from disk as they are now"),
                   true,
                   [](const ActionContext& c) { return withBuilt(c) && !c.session.rebuilding().running(); },
                   [](ActionContext& c) { c.session.reimport(); },
                   {}});
  table.push_back({"file.reimportAutomatically",
                   "File",
                   trLater("Import by itself when it changes"),
                   {},
                   {},
                   "",
                   false,
                   always,
                   [](ActionContext& c) {
                     bool& automatic = c.session.preferences().reimportAutomatically;
                     automatic = !automatic;
                     c.session.savePreferencesNow();
                   },
                   [](const ActionContext& c) { return c.session.preferences().reimportAutomatically; }});
  table.push_back({"file.locate",
                   "File",
                   trLater("Locate the model…"),
                   {},
                   {},
                   trLater("Where the model lies now, or another one to take its place"),
                   false,
                   withProject,
                   [](ActionContext& c) { c.state.dialog = Dialog::locateScene; },
                   {}});
  table.push_back(
      {"file.reload",
       "File",
       trLater("Reload from disk"),
       {},
       {},
       trLater("The project as another program has saved it; undo brings back what was here"),
       false,
       [](const ActionContext& c) { return c.session.hasProject() && c.session.projectFileChanged(); },
       [](ActionContext& c) { reload(c); },
       {},
       trLater("a project that another program has changed")});
}

}  // namespace

void addFileActions(std::vector<Action>& table) {
  table.push_back({"file.new",
                   "File",
                   trLater("New project…"),
                   {key::n, kCtrl},
                   {},
                   trLater("Choose a model; cells are laid over its floor"),
                   false,
                   always,
                   [](ActionContext& c) {
                     proceedAfterAsking(c, {Continuation::Kind::newDialog, {}});
                   },
                   {}});
  table.push_back({"file.open",
                   "File",
                   trLater("Open…"),
                   {key::o, kCtrl},
                   {},
                   trLater("A project, a walk, or a model for a new project"),
                   false,
                   always,
                   [](ActionContext& c) {
                     proceedAfterAsking(c, {Continuation::Kind::openDialog, {}});
                   },
                   {}});
  table.push_back({"file.save",
                   "File",
                   trLater("Save"),
                   {key::s, kCtrl},
                   {},
                   trLater("Save the project"),
                   true,
                   [](const ActionContext& c) { return c.session.dirty(); },
                   [](ActionContext& c) { saveThen(c, {}); },
                   {},
                   trLater("unsaved changes")});
  table.push_back({"file.saveAs",
                   "File",
                   trLater("Save as…"),
                   {key::s, kCtrlShift},
                   {},
                   trLater("Save under another name; captures go along"),
                   false,
                   withProject,
                   [](ActionContext& c) {
                     c.state.continuation = {};
                     c.state.dialog = Dialog::saveAs;
                   },
                   {}});
  addPublishActions(table);
  addOutsideActions(table);
  table.push_back({"file.close",
                   "File",
                   trLater("Close"),
                   {key::w, kCtrl},
                   {},
                   "",
                   true,
                   withProject,
                   [](ActionContext& c) {
                     proceedAfterAsking(c, {Continuation::Kind::close, {}});
                   },
                   {}});
  addPreferenceActions(table);
  table.push_back({"file.quit",
                   "File",
                   trLater("Quit"),
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
