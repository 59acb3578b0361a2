#include "editor/actions/action_table.h"

#include <algorithm>
#include <utility>

#include "editor/commands/layout_edits.h"
#include "editor/commands/setting_edits.h"
#include "editor/commands/storey_edits.h"
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

/// Actions on the selected cells, in the Edit menu.
void addCellActions(std::vector<Action>& table) {
  const auto onSelection = [&table](const char* id, const char* label, const Shortcut& shortcut,
                                    const char* help, bool (*sensible)(const LayoutSpec&, const CellId&),
                                    Edit (*edit)(const Project&, const std::set<CellId>&)) {
    table.push_back({id,
                     "Edit",
                     label,
                     shortcut,
                     {},
                     help,
                     false,
                     [sensible](const ActionContext& c) {
                       return c.session.hasProject() &&
                              std::ranges::any_of(c.state.selection, [&](const CellId& cell) {
                                return sensible(c.session.project().layout(), cell);
                              });
                     },
                     [edit](ActionContext& c) {
                       if (c.session.apply(edit(c.session.project(), c.state.selection)))
                         c.state.selection.clear();
                     },
                     {}});
  };
  onSelection("edit.split", "Split selected cells", {key::x, 0},
              "Into four of half the size, where more is to be seen or triangles are too many "
              "(configurations e and g)",
              canSplitCell, splitCells);
  onSelection(
      "edit.join", "Join what was split", {key::x, ui::modifier::shift},
      "The parts around the selected ones become one cell again",
      [](const LayoutSpec&, const CellId& cell) { return cell.level > 0; }, joinCells);
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
       "Click free ground to draw the walkable area or a hole in it, Enter closes; drag corners and sides to "
       "change it.");
  tool("tool.panorama", "Single APV", key::digit4, PlanMode::panorama,
       "Click to place a panorama beside the lattice, or drag to choose how far its cameras stand out.");
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

void addStoreyActions(std::vector<Action>& table) {
  const auto beside = [&table](const char* id, const char* label, int code, int steps, bool first) {
    table.push_back({id,
                     "Plan",
                     label,
                     {code, 0},
                     {},
                     "",
                     first,
                     [steps](const ActionContext& c) {
                       return c.session.hasProject() && storeyBeside(c.session.project(), steps);
                     },
                     [steps](ActionContext& c) {
                       c.state.selection.clear();
                       c.session.apply(
                           showStorey(c.session.project(), *storeyBeside(c.session.project(), steps)));
                     },
                     {}});
  };
  beside("storey.up", "Storey above", key::pageUp, 1, true);
  beside("storey.down", "Storey below", key::pageDown, -1, false);
  table.push_back(
      {"storey.find",
       "Plan",
       "Find more storeys",
       {},
       {},
       "Looks for floors to walk on that have no layout yet, and lays cells like this storey's on them",
       false,
       [](const ActionContext& c) { return withBuilt(c) && !c.session.searching().running(); },
       [](ActionContext& c) { c.session.findStoreys(); },
       {}});
  table.push_back({"storey.remove",
                   "Plan",
                   "Remove this storey",
                   {},
                   {},
                   "",
                   false,
                   [](const ActionContext& c) {
                     return c.session.hasProject() && c.session.project().storeys.size() > 1;
                   },
                   [](ActionContext& c) {
                     c.state.selection.clear();
                     c.session.apply(removeStorey(c.session.project()));
                   },
                   {}});
}

void addBudgetActions(std::vector<Action>& table) {
  const auto search = [&table](const char* id, const char* label, const char* help, bool onlySplit,
                               void (Session::*run)()) {
    table.push_back({id,
                     "Plan",
                     label,
                     {},
                     {},
                     help,
                     !onlySplit,
                     [onlySplit](const ActionContext& c) {
                       return withBuilt(c) && !c.session.searching().running() &&
                              c.session.project().budget.trianglesPerRegion > 0 &&
                              (!onlySplit || canSplit(c.session.project().layout().configuration));
                     },
                     [run](ActionContext& c) { (c.session.*run)(); },
                     {}});
  };
  search("budget.fit", "Fit cells to the budget",
         "The largest cells whose regions all keep to the triangle budget", false, &Session::fitCells);
  search("budget.split", "Split cells above the budget",
         "Only the cells that exceed the triangle budget (configurations e and g)", true,
         &Session::splitOverBudget);
  table.push_back({"search.cancel",
                   "Plan",
                   "Stop searching",
                   {},
                   {},
                   "",
                   false,
                   [](const ActionContext& c) {
                     return c.session.searching().running() && !c.session.searching().cancelling();
                   },
                   [](ActionContext& c) { c.session.cancelSearch(); },
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
  table.push_back({"bake.estimate",
                   "Walk",
                   "Estimate the bake",
                   {},
                   {},
                   "Tells time and bytes of what is missing, by baking a little of it",
                   false,
                   [](const ActionContext& c) {
                     return withBuilt(c) && !c.session.baking().running() &&
                            !c.session.estimating().running();
                   },
                   [](ActionContext& c) { c.session.estimateBake(); },
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
  addCellActions(table);
  addToolActions(table);
  addStoreyActions(table);
  addBudgetActions(table);
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
