/// The walk's context menu: a right click that turns nothing opens it.
#include "editor/actions/path_walk.h"
#include "editor/panels/walk_panel.h"
#include "editor/tools/ray_math.h"

namespace acentric::editor {
namespace {

constexpr const char* kPopup = "##walkMenu";

void drawItem(PanelContext& context, const char* id) {
  const Action& action = actionOf(context, id);
  const std::string text = action.label + "###" + action.id;
  if (ImGui::MenuItem(text.c_str(), describe(action.shortcut).c_str(), false,
                      action.enabled(context.actions)))
    runAction(context, action);
  context.log.item("here." + action.id);
  ui::tooltip(tooltipOf(context, action));
}

}  // namespace

void WalkPanel::openMenu(PanelContext& context, const glm::dvec2& at) {
  const OpenProject& open = *context.session().built();
  if (context.session().shippedWalk()) return;
  const PerspectiveView view = viewAt(context, 1);
  const double ground = footingOf(open, glm::dvec2(view.eye)).ground;
  context.state().pointedFloor = onLevel(rayThrough(view, at * glm::dvec2(view.width, view.height)), ground);
  ImGui::OpenPopup(kPopup);
}

void WalkPanel::drawMenu(PanelContext& context) const {
  if (!ImGui::BeginPopup(kPopup)) return;
  for (const char* id : {"walk.addCell", "walk.addApv", "walk.selectCell"}) drawItem(context, id);
  ImGui::Separator();
  for (const char* id : {"walk.addCellThere", "walk.addApvThere"}) drawItem(context, id);
  ImGui::Separator();
  for (const char* id : {"walk.setStart", "walk.screenshot"}) drawItem(context, id);
  ImGui::EndPopup();
}

}  // namespace acentric::editor
