/// The walk's context menu: a right click that turns nothing opens it.
#include "editor/actions/path_walk.h"
#include "editor/panels/walk_panel.h"
#include "editor/tools/ray_math.h"
#include "engine/bake/ray_scene.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

constexpr const char* kPopup = "##walkMenu";

void drawItem(PanelContext& context, const char* id) {
  const Action& action = actionOf(context, id);
  const std::string text = tr(action.label) + "###" + action.id;
  if (ImGui::MenuItem(text.c_str(), describe(action.shortcut).c_str(), false,
                      action.enabled(context.actions)))
    runAction(context, action);
  context.log.item("here." + action.id);
  ui::tooltip(tooltipOf(context, action));
}

/// The place of the floor under a pixel, or under the surface that is in the way.
std::optional<glm::dvec2> floorUnder(const OpenProject& open, const PointerRay& ray) {
  const auto floor = onLevel(ray, footingOf(open, glm::dvec2(ray.from)).ground);
  const Hit hit = open.rays->trace({glm::vec3(ray.from), glm::vec3(ray.way)});
  if (!hit.found()) return floor;
  constexpr double kSlack = 1.01;  // the floor's own surface is not in its way
  const glm::dvec2 met(ray.from + double(hit.distance) * ray.way), from(ray.from);
  const bool nearer = !floor || glm::distance(met, from) * kSlack < glm::distance(*floor, from);
  return nearer ? met : *floor;
}

}  // namespace

void WalkPanel::openMenu(PanelContext& context, const glm::dvec2& at) {
  const OpenProject& open = *context.session().built();
  if (context.session().shippedWalk()) return;
  const PerspectiveView view = viewAt(context, 1);
  context.state().pointedFloor = floorUnder(open, rayThrough(view, at * glm::dvec2(view.width, view.height)));
  ImGui::OpenPopup(kPopup);
}

void WalkPanel::drawMenu(PanelContext& context) {
  if (!ImGui::BeginPopup(kPopup)) return;
  for (const char* id : {"walk.addCell", "walk.addApv", "walk.selectCell"}) drawItem(context, id);
  ImGui::Separator();
  for (const char* id : {"walk.addCellThere", "walk.addApvThere"}) drawItem(context, id);
  if (ImGui::MenuItem(tr("Ask the picture where I pointed"), tr("Alt+click"))) askAt_ = menuFor_;
  context.log.item("here.ask");
  ImGui::Separator();
  for (const char* id : {"density.moreHere", "density.fewerHere"}) drawItem(context, id);
  ImGui::Separator();
  for (const char* id : {"walk.setStart", "walk.screenshot"}) drawItem(context, id);
  ImGui::EndPopup();
}

}  // namespace acentric::editor
