#pragma once
/// What the window shows and asks, as plain values: no part of the project, not on the history, not saved.

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "editor/commands/group_edits.h"
#include "editor/session/coverage.h"
#include "editor/session/guide.h"
#include "editor/tools/accuracy_state.h"
#include "editor/tools/plan_tool.h"
#include "editor/tools/scene3d_state.h"
#include "editor/tools/walk_recorder.h"
#include "editor/tools/walk_replay.h"
#include "editor/tools/walker.h"

namespace acentric::editor {

enum class Dialog {
  none,
  openFile,
  newFile,  ///< a model for a new project
  newProject,
  saveAs,
  locateScene,
  exportPath,
  unsavedChanges,
  changedOnDisk,
  commands,
  shortcuts,
  preferences,
  publish,
  about
};

/// What the pane at the lower right shows.
enum class BottomTab { messages, problems, history, paths };

/// What a new project is asked for; once its model is opened with what was derived.
struct NewProjectDraft {
  std::filesystem::path model;
  Configuration configuration = Configuration::b;
  double cellSize = 0;  ///< metres
  bool derived = true;  ///< the cell size follows from the walkable area
  double eyeHeight = 1.6;
  bool everyStorey = false;
  int generation = -1;  ///< of the session, that it was filled from
};

/// What the dialog for publishing is being told.
struct PublishDraft {
  std::string folder, publicAddress;
  bool oneFile = false, openBrowser = true;
};

/// A part of the plan, metres.
struct PlanFrame {
  glm::dvec2 low{0}, high{0};
};

/// What the walk shows of its frames.
enum class WalkLook {
  picture,
  holes,       ///< pixels without a real sample in magenta
  sources,     ///< which camera painted what
  split,       ///< beside the ray-traced truth, in one picture
  difference,  ///< from the truth, amplified
  variant,     ///< beside the variant that was kept, in one picture
};
constexpr bool needsTruth(WalkLook look) { return look == WalkLook::split || look == WalkLook::difference; }
/// Is there something else over the picture?
constexpr bool compares(WalkLook look) { return needsTruth(look) || look == WalkLook::variant; }
/// Is there a border that can be dragged?
constexpr bool isSplit(WalkLook look) { return look == WalkLook::split || look == WalkLook::variant; }

inline constexpr int kDifferenceGains[] = {1, 2, 4, 8, 16};

/// What the plan tells of its cells.
enum class PlanOverlay {
  none,
  bake,       ///< how far each is baked
  triangles,  ///< of local geometry
  bytes,      ///< on disk
  checks,     ///< where centres of projection stand badly
  coverage,   ///< how well places are sampled
  density,    ///< which cells have more or fewer samples per degree than the project
};

/// Cells to be selected as soon as the layout is inspected.
enum class SelectionWish { none, overBudget, withWarnings };

/// Plan, 3D and accuracy share the middle of the window, beside the walk.
enum class View { plan, scene3d, accuracy, walk };
/// Which fills the window alone; `centre`: the middle, with its tabs.
enum class WholeView { none, centre, walk };

/// What the user wanted when a question came in between.
struct Continuation {
  enum class Kind { none, quit, close, open, openDialog, newDialog, bake };
  Kind kind = Kind::none;
  std::filesystem::path file;
};

struct EditorState {
  PlanTool planTool;
  View planToolView = View::plan;  ///< whose pointer it follows: the plan's or the 3D view's
  Walker walker;
  std::set<CellId> selection;
  SelectionWish selectionWish = SelectionWish::none;
  std::optional<CellArray> array;   ///< of the selection, that is being laid out
  std::optional<LayoutSpec> trial;  ///< that the plan shows instead, for a look; set anew in each frame
  std::optional<CellId> frameCell;  ///< asked for; the plan clears it
  double simplifyMetres = 0.1;      ///< how far the outline's corners may move when it is simplified
  bool showTable = false;           ///< of the regions, below the plan
  WalkSelection walkSelection;
  WalkRecorder recorder;
  WalkReplay replay;                 ///< of the selected path
  std::optional<WalkPose> replayed;  ///< where it put the eye last
  std::string replayReport;          ///< of the last replay
  std::optional<WalkPose> goTo;      ///< where the eye goes as soon as the current storey is laid out
  unsigned long picturesShown = 0;   ///< of the walk; the walk counts

  View centreView = View::plan;  ///< never the walk; of four views the one that keys go to
  WholeView whole = WholeView::none;
  bool fullScreen = false;  ///< the walk alone, without menus and tools
  Scene3dState scene3d;
  AccuracyState accuracy;
  bool showBackdrop = true;
  bool showLattice = true;
  bool showCameras = true;
  PlanOverlay overlay = PlanOverlay::bake;
  double densityBrush = 2;  ///< that the tool paints: times the project's samples per degree
  CoverageKind coverageKind = CoverageKind::surfaces;
  bool showBakeCameras = false;  ///< in the bake panel, instead of the overview
  WalkLook walkLook = WalkLook::picture;
  bool showPaths = true;        ///< and bookmarks, on the plan
  double splitAt = 0.5;         ///< of the walk's width: left of it the walk, right of it the truth
  int truthRays = 4;            ///< per pixel, of kTruthRays
  int differenceGain = 4;       ///< of kDifferenceGains
  bool showFrameTimes = false;  ///< over the walk
  bool showMinimap = false;
  bool showImages = false;                 ///< beside the minimap: those that the picture is painted from
  std::optional<glm::dvec2> pointedFloor;  ///< plan; under the walk's pointer as its menu was opened
  bool walkPointed = false;                ///< the pointer is over the walk, where that is shown
  bool asking = false;                     ///< a click on the walk asks what is there
  bool takePicture = false;                ///< asked for; the walk clears it
  bool fitPlan = true;                     ///< asked for; the plan clears it
  std::optional<PlanFrame> framePlan;      ///< the same
  /// Of the settings: asked for; they clear it. "Layout", "Layout/Advanced".
  std::string openSection;
  double wantedMegabytes = 0;  ///< that a bake is to take, as typed; 0: not yet
  BottomTab bottomTab = BottomTab::messages;
  bool restart = false;  ///< the eye goes back to the start of the walk; the walk clears it

  Guide guide;
  std::vector<std::string> recentActions;  ///< ids, newest first
  int commandsOpened = 0;                  ///< how often the list of commands was
  bool openMenus = false;                  ///< by key; the menu bar clears it
  double messagesLitUntil = 0;             ///< the newest messages were asked for; seconds

  Dialog dialog = Dialog::none;
  Continuation continuation;
  NewProjectDraft draft;
  PublishDraft publishDraft;
  std::string toClipboard;  ///< asked for; the dialogs clear it
  bool quit = false;
};

}  // namespace acentric::editor
