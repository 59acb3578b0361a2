#include <fmt/format.h>

#include "editor/actions/menu_actions.h"
#include "editor/commands/group_edits.h"
#include "editor/commands/selection.h"

namespace acentric::editor {
namespace {

bool anySelected(const ActionContext& c) { return c.session.hasProject() && !c.state.selection.empty(); }

/// Tells how many places were taken.
void applyGroup(ActionContext& c, GroupEdit group, bool whole) {
  const auto tell = [&](const char* words) {
    c.session.messages().add(MessageLevel::info, fmt::format("{} place{} {}", group.skipped,
                                                             group.skipped == 1 ? "" : "s", words));
  };
  if (group.skipped > 0 && (whole || group.cells.empty()))
    return tell(group.skipped == 1 ? "is taken: nothing was moved" : "are taken: nothing was moved");
  if (group.skipped > 0)
    tell(group.skipped == 1 ? "was taken and left as it is" : "were taken and left as they are");
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
                     "By one step of the lattice, onto free places",
                     first,
                     anySelected,
                     [direction](ActionContext& c) {
                       const Project& project = c.session.project();
                       const CellGroup group(project.layout(), c.state.selection);
                       applyGroup(c, moveCells(project, c.state.selection, group.stepTowards(direction)),
                                  true);
                     },
                     {},
                     "a selected cell"});
  };
  nudge("edit.nudgeRight", "Move selection right", key::right, {1, 0}, true);
  nudge("edit.nudgeLeft", "Move selection left", key::left, {-1, 0}, false);
  nudge("edit.nudgeUp", "Move selection up", key::up, {0, 1}, false);
  nudge("edit.nudgeDown", "Move selection down", key::down, {0, -1}, false);
}

void addCopies(std::vector<Action>& table) {
  table.push_back({"edit.duplicate",
                   "Edit",
                   "Duplicate selection",
                   {key::d, kCtrl},
                   {},
                   "A copy on the nearest free places",
                   true,
                   anySelected,
                   [](ActionContext& c) {
                     const Project& project = c.session.project();
                     const auto step = CellGroup(project.layout(), c.state.selection).nearestFreeStep();
                     if (!step)
                       return c.session.messages().add(MessageLevel::info,
                                                       "There are no free places for a copy nearby");
                     applyGroup(c, copyCells(project, c.state.selection, {*step}), true);
                   },
                   {},
                   "a selected cell"});
  table.push_back(
      {"edit.array",
       "Edit",
       "Array of the selection…",
       {key::d, kCtrlShift},
       {},
       "Rows of copies along the lattice, with a preview",
       false,
       anySelected,
       [](ActionContext& c) { c.state.array = roomyArray(c.session.project().layout(), c.state.selection); },
       {},
       "a selected cell"});
  table.push_back({"edit.placeArray",
                   "",
                   "Place",
                   {},
                   {},
                   "Lays the copies that the plan shows",
                   false,
                   [](const ActionContext& c) { return anySelected(c) && c.state.array.has_value(); },
                   [](ActionContext& c) {
                     applyGroup(c, copyCells(c.session.project(), c.state.selection, c.state.array->steps()),
                                false);
                     c.state.array.reset();
                   },
                   {},
                   "an array of the selection"});
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
  select("edit.selectAll", "Select all cells", {key::a, kCtrl}, "",
         [](const ActionContext& c) { return inverted(*c.session.built()->layout, {}); });
  table.back().separatorBefore = true;
  select("edit.invertSelection", "Invert selection", {key::i, kCtrl}, "",
         [](const ActionContext& c) { return inverted(*c.session.built()->layout, c.state.selection); });
  select("edit.selectRings", "Select rings", {}, "Cells with cameras all around them",
         [](const ActionContext& c) { return ofKind(c, true); });
  select("edit.selectGaps", "Select gaps", {}, "Cells between the rings",
         [](const ActionContext& c) { return ofKind(c, false); });
  select("edit.selectNotBaked", "Select what is not baked", {}, "Cells that lack a capture",
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
                     "a triangle budget"});
  };
  wish("edit.selectOverBudget", "Select what is over budget",
       "Cells with more triangles of local geometry than the budget allows", SelectionWish::overBudget);
  wish("edit.selectWarnings", "Select what has warnings",
       "Cells that the placement checks warn of, or one of whose cameras", SelectionWish::withWarnings);
}

}  // namespace

void addSelectionActions(std::vector<Action>& table) {
  addSelecting(table);
  addNudges(table);
  addCopies(table);
}

}  // namespace acentric::editor
