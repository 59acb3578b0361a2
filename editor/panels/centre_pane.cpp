#include "editor/panels/centre_pane.h"

#include <array>

#include "editor/panels/view_strip.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

constexpr std::array<ViewTab, 3> kViews{{{"view.plan", trLater("Plan")},
                                         {"view.scene3d", trLater("3D")},
                                         {"view.accuracy", trLater("Accuracy")}}};

const ViewTab& tabOf(View view) { return kViews[std::size_t(view)]; }
static_assert(View::plan == View(0) && View::scene3d == View(1) && View::accuracy == View(2));

}  // namespace

void CentrePane::drawView(PanelContext& context, View view) {
  if (beginPane("##centreView", {0, 0}, false)) {
    if (view == View::plan) plan_.draw(context);
    if (view == View::scene3d) scene_.draw(context);
    if (view == View::accuracy) accuracy_.draw(context);
  }
  endPane();
}

void CentrePane::draw(PanelContext& context) {
  const View view = context.state().centreView;
  drawViewStrip(context, kViews, tabOf(view).id, true);
  drawView(context, view);
}

void CentrePane::drawAlone(PanelContext& context, View view) {
  View& active = context.state().centreView;
  // Not in the middle of a drag that began in another.
  const bool pointed = ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows) && !ImGui::IsAnyMouseDown();
  if (pointed) active = view;
  drawViewStrip(context, {&tabOf(view), 1}, tabOf(view).id, active == view);
  drawView(context, view);
}

}  // namespace acentric::editor
