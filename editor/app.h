#pragma once
/// The editor: owns window, session and panels, and composes them. All behaviour lives in the parts.

#include <imgui.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <stop_token>
#include <string>

#include "editor/actions/action_table.h"
#include "editor/panels/centre_pane.h"
#include "editor/panels/configuration_picker.h"
#include "editor/panels/dialogs.h"
#include "editor/panels/guide_card.h"
#include "editor/panels/menu_bar.h"
#include "editor/panels/walk_panel.h"
#include "editor/session/pane_sizes.h"
#include "editor/tools/key_focus.h"
#include "ui/toasts.h"
#include "ui/window.h"

namespace acentric::editor {

struct AppOptions {
  std::filesystem::path file;        ///< to open at once; may be empty
  std::filesystem::path sample;      ///< to open at once where no file is named, as preferences say
  std::filesystem::path uiLog;       ///< for tests: ui/ui_log.h; may be empty
  std::filesystem::path frameTimes;  ///< CSV to write, a line per frame; may be empty
  double exitAfterSeconds = 0;       ///< 0 = never
  std::stop_token stop;              ///< leave at once, and keep unsaved work for the next run
  std::optional<glm::ivec2> size;    ///< of the window; nothing = as it was left, within the screen
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
  /// All below the menus; returns the lower edge of the plan and the walk, pixels. So does drawLayout.
  float drawMain(PanelContext& context, float top);
  float drawLayout(PanelContext& context, float top);
  void drawPanels(PanelContext& context, const PaneSizes& panes, float width);
  void drawFour(PanelContext& context, const PaneSizes& panes, float width, float height);
  void drawCentre(PanelContext& context, const ImVec2& size);
  void drawWalk(PanelContext& context, const ImVec2& size);
  void drawBottom(PanelContext& context, const PaneSizes& panes);
  void drawStatus(PanelContext& context, float top);
  void giveKeys();
  void followPreferences();
  /// Texts in the language of the preferences; tells if it is not there.
  void speak();
  void startGuide();
  void runShortcuts(PanelContext& context);
  void takeDropped(PanelContext& context);
  void tellNews();
  void logNews(PanelContext& context);
  void keepDrawing(PanelContext& context);
  bool popupOpen() const;
  bool inputBlocked() const;

  AppOptions options_;
  std::unique_ptr<ui::Window>
      window_;  // first: textures and the GL renderer of the panels need its context to the end
  ui::UiLog log_;
  ui::Toasts toasts_;
  std::vector<Action> table_;
  Session session_;
  EditorState state_;
  ConfigurationPicker configurations_;
  CentrePane centre_;
  WalkPanel walk_;
  Dialogs dialogs_;
  GuideCard guideCard_;
  KeyFocus keyFocus_;
  MenuBar menuBar_;
  int menusByKey_ = 0;        ///< frames for which the keys still belong to menus
  bool guideWanted_ = false;  ///< as soon as a project is there
  std::vector<ui::InputEvent> events_;
  bool ready_ = false;
  std::string loggedSweep_, loggedGoals_;
  std::string loggedState_;
  int loggedFinished_ = 0;
  ui::Look lookAsked_;
  std::set<std::string> fontsTold_;  ///< that they are missing
  std::string tongue_;               ///< the language that was asked for last
};

}  // namespace acentric::editor
