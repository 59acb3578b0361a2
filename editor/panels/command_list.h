#pragma once
/// Two lists that are searched by typing: of all commands, which Enter runs, and of all keys.

#include <string>

#include "editor/panels/panel_context.h"
#include "ui/fields.h"

namespace acentric::editor {

class CommandList {
 public:
  /// A key that came while it is open; true if it used the event. The others type into the field.
  bool handleKey(const ui::InputEvent& event);
  bool isOpen() const { return shown_; }
  /// The one of the state's dialog: Dialog::commands or Dialog::shortcuts.
  void draw(PanelContext& context);

 private:
  void begin();
  bool drawField(const char* hint, ui::UiLog& log);
  void drawCommands(PanelContext& context);
  void drawKeys(PanelContext& context);

  std::string query_;
  int selected_ = 0;
  int steps_ = 0;  ///< by which the arrows moved since the last frame
  bool enter_ = false, escape_ = false;
  bool shown_ = false;
  bool scroll_ = false;
  ui::ReadyTextField field_;
};

}  // namespace acentric::editor
