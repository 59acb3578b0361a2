#include <utility>

#include "editor/actions/menu_actions.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

/// One at a time; what is chosen again gives way to what is baked.
void addOverlayActions(std::vector<Action>& table) {
  const auto overlay = [&table](const char* id, const char* label, int code, PlanOverlay what,
                                const char* help) {
    table.push_back(
        {id,
         "Plan",
         label,
         {code, 0},
         {},
         help,
         what == PlanOverlay::bake,
         withProject,
         [what](ActionContext& c) { c.state.overlay = c.state.overlay == what ? PlanOverlay::bake : what; },
         [what](const ActionContext& c) { return c.state.overlay == what; }});
  };
  overlay("overlay.bake", trLater("Overlay: bake state"), 0, PlanOverlay::bake,
          trLater("Which cells are baked, being baked, out of date or failed"));
  overlay("view.triangles", trLater("Overlay: triangles"), key::t, PlanOverlay::triangles,
          trLater("Cells coloured by their triangles of local geometry, against the budget"));
  overlay("overlay.bytes", trLater("Overlay: bytes"), 0, PlanOverlay::bytes,
          trLater("Cells coloured by what their captures take on disk"));
  overlay("view.checks", trLater("Overlay: placement checks"), key::p, PlanOverlay::checks,
          trLater("Where cameras stand badly, and where they would stand free"));
  overlay("view.coverage", trLater("Overlay: sampling coverage"), key::v, PlanOverlay::coverage,
          trLater("How finely places are sampled"));
  overlay("overlay.density", trLater("Overlay: sampling density"), 0, PlanOverlay::density,
          trLater("Cells with more or fewer samples per degree than the project"));
  overlay("overlay.none", trLater("No overlay"), 0, PlanOverlay::none, trLater("Borders of cells alone"));
}

void addCoverageActions(std::vector<Action>& table) {
  const auto kind = [&table](const char* id, const char* label, CoverageKind what, const char* help) {
    table.push_back({id,
                     "Plan",
                     label,
                     {},
                     {},
                     help,
                     false,
                     withProject,
                     [what](ActionContext& c) {
                       c.state.overlay = PlanOverlay::coverage;
                       c.state.coverageKind = what;
                     },
                     [what](const ActionContext& c) {
                       return c.state.overlay == PlanOverlay::coverage && c.state.coverageKind == what;
                     }});
  };
  kind("coverage.surfaces", trLater("Coverage of surfaces"), CoverageKind::surfaces,
       trLater("For each point of a surface that an eye in the walkable area can see: how finely the "
               "captures would "
               "sample it, against what the nearest eye needs."));
  kind("coverage.layout", trLater("Coverage of the plan"), CoverageKind::layout,
       trLater("How many cameras hold each point of the plan."));
  kind("coverage.cell", trLater("Coverage of a cell"), CoverageKind::cell,
       trLater("The same for the cameras at the corners of the selected cell, or of the one under the "
               "pointer; of a "
               "free panorama view its own."));
  table.push_back({"coverage.next",
                   "Plan",
                   trLater("Next kind of coverage"),
                   {key::v, ui::modifier::shift},
                   {},
                   "",
                   false,
                   withProject,
                   [](ActionContext& c) {
                     if (std::exchange(c.state.overlay, PlanOverlay::coverage) == PlanOverlay::coverage)
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
                     [mode](ActionContext& c) {
                       c.state.planTool.setMode(mode);
                       if (mode == PlanMode::density) c.state.overlay = PlanOverlay::density;
                     },
                     [mode](const ActionContext& c) { return c.state.planTool.mode() == mode; }});
  };
  tool("tool.cells", trLater("Cells"), key::digit1, PlanMode::cells,
       trLater("Click a free place to add a cell, a placed one to select it; drag to move it. Del removes, "
               "Ctrl+click too."));
  tool("tool.eye", trLater("Eye"), key::digit2, PlanMode::eye,
       trLater("Press to put the eye there, drag to turn it."));
  tool("tool.outline", trLater("Outline"), key::digit3, PlanMode::outline,
       trLater("Click free ground to draw the walkable area or a hole in it, Enter closes; drag corners and "
               "sides to "
               "change it."));
  tool("tool.panorama", trLater("Single APV"), key::digit4, PlanMode::panorama,
       trLater(
           "Click to place a panorama beside the lattice, or drag to choose how far its cameras stand out."));
  tool("tool.lattice", trLater("Lay lattice"), key::digit5, PlanMode::lattice,
       trLater("Drag the middle to move the lattice, the handle above to turn it, the one at a corner to "
               "change the "
               "cells' size; Shift snaps."));
  tool("tool.measure", trLater("Measure"), key::digit6, PlanMode::measure,
       trLater("Drag for a distance and a direction; lands on corners of walls, outline and cells."));
  tool("tool.path", trLater("Path"), key::digit7, PlanMode::path,
       trLater(
           "Click a path or its key poses to select them, drag a pose to move it, drag its tick to turn it; "
           "press on "
           "the selected path's line for a new pose, Shift+press on free ground for one at its end. Del "
           "removes, "
           "Ctrl+click too."));
  tool("tool.density", trLater("Paint density"), key::digit8, PlanMode::density,
       trLater("Press or drag over cells to give them more or fewer samples per degree than the project; "
               "Ctrl takes "
               "that back."));
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
  flag("view.backdrop", trLater("Show scene"), key::b, &EditorState::showBackdrop, true);
  flag("view.lattice", trLater("Show free lattice"), key::g, &EditorState::showLattice, false);
  flag("view.cameras", trLater("Show cameras"), key::c, &EditorState::showCameras, false);
  flag("view.table", trLater("Table of regions"), key::l, &EditorState::showTable, false);
  addOverlayActions(table);
  addCoverageActions(table);
  table.push_back({"view.fit",
                   "Plan",
                   trLater("Show everything"),
                   {key::f, 0},
                   {},
                   trLater("All that is laid out; in 3D first the selected cells, if any are"),
                   true,
                   withProject,
                   [](ActionContext& c) {
                     const bool plan = c.state.centreView == View::plan;
                     (plan ? c.state.fitPlan : c.state.scene3d.frame) = true;
                   },
                   {}});
}

}  // namespace acentric::editor
