#include <fmt/format.h>

#include "editor/actions/menu_actions.h"
#include "editor/commands/group_edits.h"
#include "editor/commands/selection.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

bool anySelected(const ActionContext& c) { return c.session.hasProject() && !c.state.selection.empty(); }

/// Tells how many places were taken.
void applyGroup(ActionContext& c, GroupEdit group, bool whole) {
  const std::size_t skipped = group.skipped;
  if (skipped > 0 && (whole || group.cells.empty()))
    return c.session.messages().add(MessageLevel::info,
                                    trfMany("{} place is taken: nothing was moved",
                                            "{} places are taken: nothing was moved", skipped, skipped));
  if (skipped > 0)
    c.session.messages().add(MessageLevel::info,
                             trfMany("{} place was taken and left as it is",
                                     "{} places were taken and left as they are", skipped, skipped));
  if (c.session.apply(std::move(group.edit))) c.state.selection = std::move(group.cells);
}

void addNudges(std::vector<Action>& table) {
  const auto nudge = [&table](const char* id, const char* label, int code, const glm::dvec2& direction,
                              bool first) {
    table.push_back({id,
                     "Edit",
                     label,
                     {code, kCtrl},
                     {},
                     trLater("By one step of the lattice, onto free places"),
                     first,
                     anySelected,
                     [direction](ActionContext& c) {
                       const Project& project = c.session.project();
                       const CellGroup group(project.layout(), c.state.selection);
                       applyGroup(c, moveCells(project, c.state.selection, group.stepTowards(direction)),
                                  true);
                     },
                     {},
                     trLater("a selected cell")});
  };
  nudge("edit.nudgeRight", trLater("Move selection right"), key::right, {1, 0}, true);
  nudge("edit.nudgeLeft", trLater("Move selection left"), key::left, {-1, 0}, false);
  nudge("edit.nudgeUp", trLater("Move selection up"), key::up, {0, 1}, false);
  nudge("edit.nudgeDown", trLater("Move selection down"), key::down, {0, -1}, false);
}

void addCopies(std::vector<Action>& table) {
  table.push_back({"edit.duplicate",
                   "Edit",
                   trLater("Duplicate selection"),
                   {key::d, kCtrl},
                   {},
                   trLater("A copy on the nearest free places"),
                   true,
                   anySelected,
                   [](ActionContext& c) {
                     const Project& project = c.session.project();
                     const auto step = CellGroup(project.layout(), c.state.selection).nearestFreeStep();
                     if (!step)
                       return c.session.messages().add(MessageLevel::info,
                                                       tr("There are no free places for a copy nearby"));
                     applyGroup(c, copyCells(project, c.state.selection, {*step}), true);
                   },
                   {},
                   trLater("a selected cell")});
  table.push_back(
      {"edit.array",
       "Edit",
       trLater("Array of the selection…"),
       {key::d, kCtrlShift},
       {},
       trLater("Rows of copies along the lattice, with a preview"),
       false,
       anySelected,
       [](ActionContext& c) { c.state.array = roomyArray(c.session.project().layout(), c.state.selection); },
       {},
       trLater("a selected cell")});
  table.push_back({"edit.placeArray",
                   "",
                   trLater("Place"),
                   {},
                   {},
                   trLater("Lays the copies that the plan shows"),
                   false,
                   [](const ActionContext& c) { return anySelected(c) && c.state.array.has_value(); },
                   [](ActionContext& c) {
                     applyGroup(c, copyCells(c.session.project(), c.state.selection, c.state.array->steps()),
                                false);
                     c.state.array.reset();
                   },
                   {},
                   trLater("an array of the selection")});
}

std::set<CellId> ofKind(const ActionContext& c, bool ring) {
  const Layout& layout = *c.session.built()->layout;
  return cellsWhere(layout,
                    [&](std::size_t r) { return (layout.regions[r].kind == RegionKind::ring) == ring; });
}

void addSelecting(std::vector<Action>& table) {
  const auto select = [&table](const char* id, const char* label, const Shortcut& shortcut, const char* help,
                               std::set<CellId> (*cells)(const ActionContext&)) {
    table.push_back({id,
                     "Edit",
                     label,
                     shortcut,
                     {},
                     help,
                     false,
                     withBuilt,
                     [cells](ActionContext& c) { c.state.selection = cells(c); },
                     {}});
  };
  select("edit.selectAll", trLater("Select all cells"), {key::a, kCtrl}, "",
         [](const ActionContext& c) { return inverted(*c.session.built()->layout, {}); });
  table.back().separatorBefore = true;
  select("edit.invertSelection", trLater("Invert selection"), {key::i, kCtrl}, "",
         [](const ActionContext& c) { return inverted(*c.session.built()->layout, c.state.selection); });
  select("edit.selectRings", trLater("Select rings"), {}, trLater("Cells with cameras all around them"),
         [](const ActionContext& c) { return ofKind(c, true); });
  select("edit.selectGaps", trLater("Select gaps"), {}, trLater("Cells between the rings"),
         [](const ActionContext& c) { return ofKind(c, false); });
  select("edit.selectNotBaked", trLater("Select what is not baked"), {}, trLater("Cells that lack a capture"),
         [](const ActionContext& c) {
           const auto& captures = c.session.captures();
           return cellsWhere(*c.session.built()->layout, [&](std::size_t r) {
             return !captures || r >= captures->regions.size() || captures->regions[r] != BakeState::baked;
           });
         });
  const auto wish = [&table](const char* id, const char* label, const char* help, SelectionWish what) {
    table.push_back({id,
                     "Edit",
                     label,
                     {},
                     {},
                     help,
                     false,
                     [what](const ActionContext& c) {
                       return withBuilt(c) && (what != SelectionWish::overBudget ||
                                               c.session.project().budget.trianglesPerRegion > 0);
                     },
                     [what](ActionContext& c) { c.state.selectionWish = what; },
                     {},
                     trLater("a triangle budget")});
  };
  wish("edit.selectOverBudget", trLater("Select what is over budget"),
       trLater("Cells with more triangles of local geometry than the budget allows"),
       SelectionWish::overBudget);
  wish("edit.selectWarnings", trLater("Select what has warnings"),
       trLater("Cells that the placement checks warn of, or one of whose cameras"),
       SelectionWish::withWarnings);
}

}  // namespace

void addSelectionActions(std::vector<Action>& table) {
  addSelecting(table);
  addNudges(table);
  addCopies(table);
}

}  // namespace acentric::editor
