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
  std::string menu;  ///< "Edit"; empty = in no menu
  std::string label;
  Shortcut shortcut;
  Shortcut alternative;  ///< a second key
  std::string help;
  bool separatorBefore = false;
  std::function<bool(const ActionContext&)> enabled;
  std::function<void(ActionContext&)> run;
  std::function<bool(const ActionContext&)> checked;  ///< for switches; else empty
};

/// Does it at once, or first asks about unsaved changes where it would lose them.
void proceedAfterAsking(ActionContext& context, const Continuation& continuation);
/// Does it: the question is answered.
void proceed(ActionContext& context, const Continuation& continuation);
/// Saves to the project's file, or asks where if it has none. `then` follows when it is saved.
void saveThen(ActionContext& context, const Continuation& then);
/// Saves as `file`, then does what was waiting. A failure is told and what was waiting is dropped.
void saveAsThen(ActionContext& context, const std::filesystem::path& file, const Continuation& then);

}  // namespace acentric::editor
