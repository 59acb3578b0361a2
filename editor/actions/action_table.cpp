#include "editor/actions/action_table.h"

#include <algorithm>
#include <utility>

#include "editor/commands/layout_edits.h"
#include "editor/commands/setting_edits.h"
#include "ui/keys.h"

namespace acentric::editor {
namespace {

namespace key = ui::key;
constexpr int kCtrl = ui::modifier::control;
constexpr int kCtrlShift = ui::modifier::control | ui::modifier::shift;

bool always(const ActionContext&) { return true; }
bool withProject(const ActionContext& c) { return c.session.hasProject(); }
bool withBuilt(const ActionContext& c) { return c.session.hasProject() && c.session.built() != nullptr; }

void addFileActions(std::vector<Action>& table) {
  table.push_back({"file.open",
                   "File",
                   "Open…",
                   {key::o, kCtrl},
                   {},
                   "A project, or a model for a new project",
                   false,
                   always,
                   [](ActionContext& c) {
                     proceedAfterAsking(c, {Continuation::Kind::openDialog, {}});
                   },
                   {}});
  table.push_back({"file.save",
                   "File",
                   "Save",
                   {key::s, kCtrl},
                   {},
                   "Save the project",
                   true,
                   [](const ActionContext& c) { return c.session.dirty(); },
                   [](ActionContext& c) { saveThen(c, {}); },
                   {}});
  table.push_back({"file.saveAs",
                   "File",
                   "Save as…",
                   {key::s, kCtrlShift},
                   {},
                   "Save under another name; captures go along",
                   false,
                   withProject,
                   [](ActionContext& c) {
                     c.state.continuation = {};
                     c.state.dialog = Dialog::saveAs;
                   },
                   {}});
  table.push_back({"file.close",
                   "File",
                   "Close project",
                   {key::w, kCtrl},
                   {},
                   "",
                   false,
                   withProject,
                   [](ActionContext& c) {
                     proceedAfterAsking(c, {Continuation::Kind::close, {}});
                   },
                   {}});
  table.push_back({"file.quit",
                   "File",
                   "Quit",
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

void selectAll(ActionContext& c) {
  c.state.selection.clear();
  for (const Region& region : c.session.built()->layout->regions) c.state.selection.insert(region.id);
}

void addEditActions(std::vector<Action>& table) {
  table.push_back(
      {"edit.undo",
       "Edit",
       "Undo",
       {key::z, kCtrl},
       {},
       "",
       false,
       [](const ActionContext& c) { return c.session.hasProject() && c.session.history().canUndo(); },
       [](ActionContext& c) { c.session.undo(); },
       {}});
  table.push_back(
      {"edit.redo",
       "Edit",
       "Redo",
       {key::y, kCtrl},
       {key::z, kCtrlShift},
       "",
       false,
       [](const ActionContext& c) { return c.session.hasProject() && c.session.history().canRedo(); },
       [](ActionContext& c) { c.session.redo(); },
       {}});
  table.push_back({"edit.selectAll",
                   "Edit",
                   "Select all cells",
                   {key::a, kCtrl},
                   {},
                   "",
                   true,
                   withBuilt,
                   selectAll,
                   {}});
  table.push_back(
      {"edit.remove",
       "Edit",
       "Remove selected cells",
       {key::del, 0},
       {key::backspace, 0},
       "",
       false,
       [](const ActionContext& c) { return c.session.hasProject() && !c.state.selection.empty(); },
       [](ActionContext& c) {
         c.session.apply(removeCells(c.session.project(), c.state.selection));
         c.state.selection.clear();
       },
       {}});
}

void addCoverageActions(std::vector<Action>& table) {
  const auto kind = [&table](const char* id, const char* label, CoverageKind what, const char* help) {
    table.push_back(
        {id,
         "Plan",
         label,
         {},
         {},
         help,
         false,
         withProject,
         [what](ActionContext& c) {
           c.state.showCoverage = true;
           c.state.coverageKind = what;
         },
         [what](const ActionContext& c) { return c.state.showCoverage && c.state.coverageKind == what; }});
  };
  kind("coverage.surfaces", "Coverage of surfaces", CoverageKind::surfaces,
       "For each point of a surface that an eye in the walkable area can see: how finely the captures would "
       "sample it, against what the nearest eye needs.");
  kind("coverage.layout", "Coverage of the plan", CoverageKind::layout,
       "How many cameras hold each point of the plan.");
  kind("coverage.cell", "Coverage of a cell", CoverageKind::cell,
       "The same for the cameras at the corners of the selected cell, or of the one under the pointer; of a "
       "free panorama view its own.");
  table.push_back({"coverage.next",
                   "Plan",
                   "Next kind of coverage",
                   {key::v, ui::modifier::shift},
                   {},
                   "",
                   false,
                   withProject,
                   [](ActionContext& c) {
                     if (std::exchange(c.state.showCoverage, true))
                       c.state.coverageKind = CoverageKind((int(c.state.coverageKind) + 1) % 3);
                   },
                   {}});
}

void addToolActions(std::vector<Action>& table) {
  const auto tool = [&table](const char* id, const char* label, int code, PlanMode mode, const char* help) {
    table.push_back({id,
                     "Plan",
                     label,
                     {code, 0},
                     {},
                     help,
                     false,
                     withProject,
                     [mode](ActionContext& c) { c.state.planTool.setMode(mode); },
                     [mode](const ActionContext& c) { return c.state.planTool.mode() == mode; }});
  };
  tool("tool.cells", "Cells", key::digit1, PlanMode::cells,
       "Click a free place to add a cell, a placed one to select it; drag to move it. Del removes, "
       "Ctrl+click too.");
  tool("tool.eye", "Eye", key::digit2, PlanMode::eye, "Press to put the eye there, drag to turn it.");
  tool("tool.outline", "Outline", key::digit3, PlanMode::outline,
       "Click the corners of the walkable area; click the first one or press Enter to close.");
  const auto flag = [&table](const char* id, const char* label, int code, bool EditorState::*member,
                             bool first) {
    table.push_back({id,
                     "Plan",
                     label,
                     {code, 0},
                     {},
                     "",
                     first,
                     withProject,
                     [member](ActionContext& c) { c.state.*member = !(c.state.*member); },
                     [member](const ActionContext& c) { return c.state.*member; }});
  };
  flag("view.backdrop", "Show scene", key::b, &EditorState::showBackdrop, true);
  flag("view.lattice", "Show free lattice", key::g, &EditorState::showLattice, false);
  flag("view.cameras", "Show cameras", key::c, &EditorState::showCameras, false);
  flag("view.triangles", "Colour cells by triangles", key::t, &EditorState::showTriangles, false);
  flag("view.checks", "Show placement checks", key::p, &EditorState::showChecks, false);
  flag("view.coverage", "Show sampling coverage", key::v, &EditorState::showCoverage, false);
  addCoverageActions(table);
  table.push_back({"view.fit",
                   "Plan",
                   "Fit plan",
                   {key::f, 0},
                   {},
                   "Show everything that is laid out",
                   true,
                   withProject,
                   [](ActionContext& c) { c.state.fitPlan = true; },
                   {}});
}

void addWalkActions(std::vector<Action>& table) {
  table.push_back({"bake.start",
                   "Walk",
                   "Bake",
                   {key::b, kCtrl},
                   {},
                   "Bake what is missing, nearest to the start first",
                   false,
                   [](const ActionContext& c) { return withBuilt(c) && !c.session.baking().running(); },
                   [](ActionContext& c) {
                     if (c.session.untitled()) return saveThen(c, {Continuation::Kind::bake, {}});
                     c.session.startBake();
                   },
                   {}});
  table.push_back({"bake.cancel",
                   "Walk",
                   "Cancel bake",
                   {},
                   {},
                   "What is finished stays",
                   false,
                   [](const ActionContext& c) {
                     return c.session.baking().running() && !c.session.baking().cancelling();
                   },
                   [](ActionContext& c) { c.session.cancelBake(); },
                   {}});
  table.push_back({"walk.restart",
                   "Walk",
                   "Go to start",
                   {key::home, 0},
                   {},
                   "",
                   true,
                   withBuilt,
                   [](ActionContext& c) { c.state.restart = true; },
                   {}});
  table.push_back({"walk.setStart",
                   "Walk",
                   "Start here",
                   {key::home, kCtrl},
                   {},
                   "The walk begins where the eye is now, and baking begins near it",
                   false,
                   withBuilt,
                   [](ActionContext& c) {
                     const WalkPose& pose = c.state.walker.pose();
                     c.session.apply(setSpawn(c.session.project(), {glm::dvec2(pose.eye), pose.yawRadians}));
                   },
                   {}});
  table.push_back({"view.holes",
                   "Walk",
                   "Mark holes",
                   {key::h, 0},
                   {},
                   "Pixels without a real sample in magenta, those filled in by guesswork too",
                   true,
                   withProject,
                   [](ActionContext& c) { c.state.showHoles = !c.state.showHoles; },
                   [](const ActionContext& c) { return c.state.showHoles; }});
}

void addHelpActions(std::vector<Action>& table) {
  table.push_back({"help.shortcuts",
                   "Help",
                   "Keys and mouse",
                   {key::f1, 0},
                   {},
                   "",
                   false,
                   always,
                   [](ActionContext& c) { c.state.dialog = Dialog::shortcuts; },
                   {}});
  table.push_back({"help.about",
                   "Help",
                   "About Acentric",
                   {},
                   {},
                   "",
                   false,
                   always,
                   [](ActionContext& c) { c.state.dialog = Dialog::about; },
                   {}});
}

}  // namespace

std::vector<Action> makeActionTable() {
  std::vector<Action> table;
  addFileActions(table);
  addEditActions(table);
  addToolActions(table);
  addWalkActions(table);
  addHelpActions(table);
  return table;
}

const Action* findAction(const std::vector<Action>& table, const std::string& id) {
  const auto found =
      std::find_if(table.begin(), table.end(), [&id](const Action& action) { return action.id == id; });
  return found == table.end() ? nullptr : &*found;
}

const Action* findAction(const std::vector<Action>& table, const Shortcut& shortcut) {
  if (shortcut.key == 0) return nullptr;
  const auto found = std::find_if(table.begin(), table.end(), [&shortcut](const Action& action) {
    return action.shortcut == shortcut || action.alternative == shortcut;
  });
  return found == table.end() ? nullptr : &*found;
}

}  // namespace acentric::editor
