#include <fmt/format.h>

#include "editor/actions/menu_actions.h"
#include "editor/commands/layout_edits.h"
#include "editor/commands/outline_edits.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

bool withOutline(const ActionContext& c) {
  return c.session.hasProject() && !c.session.project().layout().outline.empty();
}

}  // namespace

void addOutlineActions(std::vector<Action>& table) {
  table.push_back(
      {"outline.fromScene",
       "Plan",
       trLater("Outline from the scene"),
       {},
       {},
       trLater("The walkable area about this floor, as a new project finds it: where a person has head "
               "room and stands clear of walls"),
       true,
       [](const ActionContext& c) { return withBuilt(c) && !c.session.searching().running(); },
       [](ActionContext& c) { c.session.outlineFromScene(); },
       {}});
  table.push_back(
      {"layout.fit",
       "Plan",
       trLater("Fit cells to the floor"),
       {},
       {},
       trLater("Moves and turns the lattice and leaves out cells with hardly any floor, so that few cameras "
               "serve much of it and stand free. Cells that were added, removed or split are laid anew"),
       false,
       [](const ActionContext& c) { return withBuilt(c) && !c.session.searching().running(); },
       [](ActionContext& c) { c.session.fitToFloor(); },
       {}});
  table.push_back({"outline.simplify",
                   "Plan",
                   trLater("Simplify outline"),
                   {},
                   {},
                   trLater("Fewer corners, none farther from the outline than the distance beside it"),
                   false,
                   withOutline,
                   [](ActionContext& c) {
                     const Project& project = c.session.project();
                     Edit edit = simplifyOutline(project, c.state.simplifyMetres);
                     const std::size_t before = cornersOf(project.layout().outline),
                                       after = cornersOf(edit.project.layout().outline);
                     c.session.messages().add(
                         MessageLevel::info,
                         before == after ? tr("No corner of the outline can go within this distance")
                                         : trf("The outline has {} corners, {} before", after, before));
                     c.session.apply(std::move(edit));
                   },
                   {}});
  table.push_back({"outline.clear",
                   "Plan",
                   trLater("Clear outline"),
                   {},
                   {},
                   trLater("Cells are then placed by hand only"),
                   false,
                   withOutline,
                   [](ActionContext& c) { c.session.apply(setOutline(c.session.project(), {})); },
                   {}});
}

}  // namespace acentric::editor
