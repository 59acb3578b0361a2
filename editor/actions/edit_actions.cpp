#include <algorithm>

#include "editor/actions/menu_actions.h"
#include "editor/commands/layout_edits.h"

namespace acentric::editor {
namespace {

void selectAll(ActionContext& c) {
  c.state.selection.clear();
  for (const Region& region : c.session.built()->layout->regions) c.state.selection.insert(region.id);
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

}  // namespace

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
  addCellActions(table);
}

}  // namespace acentric::editor
