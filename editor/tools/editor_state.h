#pragma once
/// What the window shows and asks, as plain values: no part of the project, not on the history, not saved.

#include <filesystem>
#include <optional>
#include <set>

#include "editor/session/coverage.h"
#include "editor/tools/plan_tool.h"
#include "editor/tools/walker.h"

namespace acentric::editor {

enum class Dialog { none, openFile, saveAs, unsavedChanges, shortcuts, about };

/// What the walk shows of its frames.
enum class WalkLook {
  picture,
  holes,    ///< pixels without a real sample in magenta
  sources,  ///< which camera painted what
};

/// What the user wanted when a question came in between.
struct Continuation {
  enum class Kind { none, quit, close, open, openDialog, bake };
  Kind kind = Kind::none;
  std::filesystem::path file;
};

struct EditorState {
  PlanTool planTool;
  Walker walker;
  std::set<CellId> selection;

  bool showBackdrop = true;
  bool showLattice = true;
  bool showCameras = true;
  bool showTriangles = false;  ///< cells coloured by their local triangles instead of what is baked
  bool showChecks = false;     ///< where centres of projection stand badly
  bool showCoverage = false;   ///< instead of what is baked: how well places are sampled
  CoverageKind coverageKind = CoverageKind::surfaces;
  bool showBakeCameras = false;  ///< in the bake panel, instead of the overview
  WalkLook walkLook = WalkLook::picture;
  bool fitPlan = true;   ///< asked for; the plan clears it
  bool restart = false;  ///< the eye goes back to the start of the walk; the walk clears it

  Dialog dialog = Dialog::none;
  Continuation continuation;
  bool quit = false;
};

}  // namespace acentric::editor
