#pragma once
/// A thing that the user can do. Menus, keys and buttons all come from the one table (action_table.h).

#include <functional>
#include <string>

#include "editor/actions/shortcut.h"
#include "editor/session/session.h"
#include "editor/tools/editor_state.h"

namespace acentric::editor {

struct ActionContext {
  Session& session;
  EditorState& state;
};

struct Action {
  std::string id;    ///< "edit.undo": stable, for tests and the log
  std::string menu;  ///< "Edit"; empty = in no menu. As all texts here in English: tr() where it is shown
  std::string label;
  Shortcut shortcut;
  Shortcut alternative;  ///< a second key
  std::string help;
  bool separatorBefore = false;
  std::function<bool(const ActionContext&)> enabled;
  std::function<void(ActionContext&)> run;
  std::function<bool(const ActionContext&)> checked;  ///< for switches; else empty
  std::string needs = {};                             ///< beside an open project: "a selected cell"
  bool needsProject = false;                          ///< a walk in its place does not do
};

/// The menu it is in, in English; of one that is in none "Window".
std::string menuOf(const Action& action);
/// Why it cannot be done now, in a few words; empty if it can.
std::string whyDisabled(const Action& action, const ActionContext& context);
/// What the guided start watches.
GuideFacts guideFacts(const ActionContext& context);
/// After a project or a walk was opened: nothing is selected or played, and of a walk nothing is shown that
/// only a project has.
void beginAfresh(ActionContext& context);
/// Puts it first among those that were used last.
void noteUse(EditorState& state, const std::string& id);

/// Does it at once, or first asks about unsaved changes where it would lose them.
void proceedAfterAsking(ActionContext& context, const Continuation& continuation);
/// Does it: the question is answered.
void proceed(ActionContext& context, const Continuation& continuation);
/// Saves to the project's file, or asks: where, if it has none or is another editor's; what to do, if another
/// program has changed it. `then` follows when it is saved.
void saveThen(ActionContext& context, const Continuation& then);
/// The same over what another program has saved.
void overwriteThen(ActionContext& context, const Continuation& then);
/// What another program has saved; a failure is told.
void reload(ActionContext& context);
/// Saves as `file`, then does what was waiting. A failure is told and what was waiting is dropped.
void saveAsThen(ActionContext& context, const std::filesystem::path& file, const Continuation& then);

}  // namespace acentric::editor
