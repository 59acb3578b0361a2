#pragma once
/// Questions and failures, as modal dialogs.

#include <deque>

#include "editor/panels/command_list.h"
#include "editor/panels/panel_context.h"
#include "ui/file_browser.h"

namespace acentric::editor {

class Dialogs {
 public:
  /// A request that failed: shown one at a time until dismissed.
  void showFailure(const std::string& text) { failures_.push_back(text); }
  bool anyOpen() const;
  /// Is one open in which Tab and arrows go from widget to widget?
  bool navigable() const { return open_; }
  /// Keys go here first; what it uses is taken out of `events`.
  void handleKeys(std::vector<ui::InputEvent>& events);
  void draw(PanelContext& context);

 private:
  void openFileDialogs(PanelContext& context);
  void askAboutScale(PanelContext& context);
  void drawFailure(PanelContext& context);
  void drawUnsavedChanges(PanelContext& context);
  void drawRecovery(PanelContext& context);
  void drawOpening(PanelContext& context);
  void drawPreferencesDialog(PanelContext& context);
  void drawAbout(PanelContext& context);

  ui::FileBrowser browser_;
  CommandList commands_;
  std::deque<std::string> failures_;
  bool enter_ = false;  // pressed this frame, while a dialog of ours is open
  bool escape_ = false;
  bool open_ = false;             // one of ours, last frame
  std::filesystem::path judged_;  // the model whose scale was asked about, or is not in doubt
};

}  // namespace acentric::editor
