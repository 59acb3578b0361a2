#pragma once
/// The editor: owns window, session and panels, and composes them. All behaviour lives in the parts.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "editor/actions/action_table.h"
#include "editor/panels/dialogs.h"
#include "editor/panels/plan_panel.h"
#include "editor/panels/walk_panel.h"
#include "ui/toasts.h"
#include "ui/window.h"

namespace acentric::editor {

struct AppOptions {
  std::filesystem::path file;        ///< to open at once; may be empty
  std::filesystem::path uiLog;       ///< for tests: ui/ui_log.h; may be empty
  std::filesystem::path frameTimes;  ///< CSV to write, a line per frame; may be empty
  double exitAfterSeconds = 0;       ///< 0 = never
  int width = 1600;
  int height = 900;
  ImportHost importHost;
};

class App {
 public:
  /// The error is one line for a person.
  static tl::expected<std::unique_ptr<App>, std::string> create(const AppOptions& options);
  ~App();
  void run();

 private:
  explicit App(const AppOptions& options, std::unique_ptr<ui::Window> window);
  void update();
  void draw();
  void drawLayout(PanelContext& context, float top);
  void drawBottom(PanelContext& context, float height);
  void runShortcuts(PanelContext& context);
  void takeDropped(PanelContext& context);
  void tellNews();
  void logNews(PanelContext& context);
  void keepDrawing(PanelContext& context);
  bool inputBlocked() const;

  AppOptions options_;
  std::unique_ptr<ui::Window>
      window_;  // first: textures and the GL renderer of the panels need its context to the end
  ui::UiLog log_;
  ui::Toasts toasts_;
  std::vector<Action> table_;
  Session session_;
  EditorState state_;
  PlanPanel plan_;
  WalkPanel walk_;
  Dialogs dialogs_;
  std::vector<ui::InputEvent> events_;
  bool ready_ = false;
  std::string loggedState_;
};

}  // namespace acentric::editor
