#include <algorithm>
#include <utility>

#include "editor/actions/menu_actions.h"
#include "editor/commands/layout_edits.h"
#include "editor/commands/walk_edits.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

/// Nothing else is what the gizmo of the 3D view is at.
bool alone3d(const ActionContext& c, PlanMode mode) {
  const PlanMode now = c.state.planTool.mode();
  return now == mode ||
         (now == PlanMode::cells && c.state.centreView == View::scene3d && c.state.selection.empty());
}

bool withPose(const ActionContext& c) {
  return alone3d(c, PlanMode::path) && c.state.walkSelection.poseIn(c.session.project()).has_value();
}

bool withCorner(const ActionContext& c) {
  return alone3d(c, PlanMode::outline) && c.state.centreView == View::scene3d && !withPose(c) &&
         placeOf(c.session.project().layout().outline, c.state.scene3d.corner);
}

void removeCorner(ActionContext& c) {
  const OutlineCorner corner = *std::exchange(c.state.scene3d.corner, std::nullopt);
  Outline outline = c.session.project().layout().outline;
  auto& loop = outline.loops[corner.loop];
  loop.erase(loop.begin() + std::ptrdiff_t(corner.corner));
  if (loop.size() < 3) outline.loops.erase(outline.loops.begin() + std::ptrdiff_t(corner.loop));
  c.session.apply(setOutline(c.session.project(), std::move(outline)));
}

void removePose(ActionContext& c) {
  WalkSelection& selected = c.state.walkSelection;
  const CameraPath& path = c.session.project().paths[selected.number].path;
  if (c.session.apply(setPath(c.session.project(), selected.number, withoutPose(path, *selected.pose))))
    selected.pose.reset();
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
                     {},
                     trLater("a selected cell for which it makes sense")});
  };
  onSelection("edit.split", trLater("Split selected cells"), {key::x, 0},
              trLater("Into four of half the size, where more is to be seen or triangles are too many "
                      "(configurations e and g)"),
              canSplitCell, splitCells);
  onSelection(
      "edit.join", trLater("Join what was split"), {key::x, ui::modifier::shift},
      trLater("The parts around the selected ones become one cell again"),
      [](const LayoutSpec& spec, const CellId& cell) {
        return canSplit(spec.configuration) && cell.level > 0;
      },
      joinCells);
}

}  // namespace

void addEditActions(std::vector<Action>& table) {
  table.push_back(
      {"edit.undo",
       "Edit",
       trLater("Undo"),
       {key::z, kCtrl},
       {},
       "",
       false,
       [](const ActionContext& c) { return c.session.hasProject() && c.session.history().canUndo(); },
       [](ActionContext& c) { c.session.undo(); },
       {},
       trLater("something to undo")});
  table.push_back(
      {"edit.redo",
       "Edit",
       trLater("Redo"),
       {key::y, kCtrl},
       {key::z, kCtrlShift},
       "",
       false,
       [](const ActionContext& c) { return c.session.hasProject() && c.session.history().canRedo(); },
       [](ActionContext& c) { c.session.redo(); },
       {},
       trLater("something that was undone")});
  addSelectionActions(table);
  table.push_back({"edit.remove",
                   "Edit",
                   trLater("Remove selected cells or key pose"),
                   {key::del, 0},
                   {key::backspace, 0},
                   "",
                   true,
                   [](const ActionContext& c) {
                     return c.session.hasProject() &&
                            (!c.state.selection.empty() || withPose(c) || withCorner(c));
                   },
                   [](ActionContext& c) {
                     if (withPose(c)) return removePose(c);
                     if (withCorner(c)) return removeCorner(c);
                     c.session.apply(removeCells(c.session.project(), c.state.selection));
                     c.state.selection.clear();
                   },
                   {},
                   trLater("a selected cell or key pose")});
  addCellActions(table);
  addDensityActions(table);
}

}  // namespace acentric::editor
