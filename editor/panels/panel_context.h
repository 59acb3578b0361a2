#pragma once
/// What every panel is handed when it draws, and the helpers that tie widgets to the table of actions.

#include <string>
#include <vector>

#include "editor/actions/action_table.h"
#include "ui/fields.h"
#include "ui/theme.h"
#include "ui/ui_log.h"
#include "ui/widgets.h"
#include "ui/window.h"

namespace acentric::editor {

struct PanelContext {
  ActionContext actions;
  const std::vector<Action>& table;
  ui::Window& window;
  ui::UiLog& log;
  const std::vector<ui::InputEvent>& events;  ///< of this frame, oldest first
  bool inputBlocked = false;                  ///< a dialog, menu or toast takes the pointer and the keys
  double now = 0;                             ///< seconds, monotonic
  bool keysOnWidgets = false;                 ///< arrows go to widgets, not to the walk

  Session& session() { return actions.session; }
  EditorState& state() { return actions.state; }
};

/// tool: of a row of which one is chosen; as icons they differ from switches.
enum class ButtonLook { plain, primary, toggle, tool };

/// A button of an action: its label (or `label`), enabled state, help and shortcut; logged by the action's
/// id.
void actionButton(PanelContext& context, const char* id, ButtonLook look = ButtonLook::plain,
                  const ImVec2& size = {0, 0}, const char* label = nullptr);
/// The same as a picture; as `word` where the machine has no icons.
void actionIcon(PanelContext& context, const char* id, ui::Icon icon, ButtonLook look, const char* word);
/// Of that name, which has to be in the table.
const Action& actionOf(const PanelContext& context, const char* id);
/// What it is called and which key does it, then what it does, then why it cannot be done now.
std::string tooltipOf(const PanelContext& context, const Action& action);
/// Runs it if it is enabled; logged.
void runAction(PanelContext& context, const Action& action);

/// A pane of the main layout.
bool beginPane(const char* id, const ImVec2& size, bool padded = true);
void endPane();

/// A field's edit as an edit of the project: one history entry per drag.
void applyFieldEdit(PanelContext& context, const ui::FieldEdit& field, Edit edit);

}  // namespace acentric::editor
