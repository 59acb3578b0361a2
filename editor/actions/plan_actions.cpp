#include <utility>

#include "editor/actions/menu_actions.h"

namespace acentric::editor {
namespace {

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

}  // namespace

void addPlanActions(std::vector<Action>& table) {
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

}  // namespace acentric::editor
