#include "editor/panels/centre_pane.h"

#include "ui/colour.h"

namespace acentric::editor {
namespace {

constexpr float kTabHeight = 30;

void tab(PanelContext& context, const char* id, const char* label) {
  const Action& action = *findAction(context.table, std::string(id));
  const bool on = action.checked(context.actions);
  const std::string why = whyDisabled(action, context.actions);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 text = ImGui::CalcTextSize(label);
  const ImVec2 size(text.x + 32, kTabHeight);
  if (ImGui::InvisibleButton(id, size)) runAction(context, action);
  context.log.item(id);
  const bool hovered = ImGui::IsItemHovered();
  ui::tooltip(action.help + "  [" + describe(action.shortcut) + "]" +
              (why.empty() ? "" : "\nNot now: " + why));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end(at.x + size.x, at.y + size.y);
  if (on || (hovered && why.empty()))
    list.AddRectFilled(at, end, (on ? ui::palette::panel : ui::palette::raised).packed());
  if (on) list.AddRectFilled(at, {end.x, at.y + 2}, ui::palette::accent.packed());
  const ui::Colour& ink = !why.empty() ? ui::palette::faint : on ? ui::palette::text : ui::palette::muted;
  list.AddText({at.x + 16, at.y + (size.y - text.y) / 2}, ink.packed(), label);
}

}  // namespace

void CentrePane::draw(PanelContext& context) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + width, at.y + kTabHeight},
                                            ui::palette::backdrop.packed());
  tab(context, "view.plan", "Plan");
  ImGui::SameLine(0, 0);
  tab(context, "view.scene3d", "3D");
  ImGui::SameLine(0, 0);
  tab(context, "view.accuracy", "Accuracy");
  ImGui::SetCursorScreenPos({at.x, at.y + kTabHeight});
  if (beginPane("##centreView", {0, 0}, false)) {
    switch (context.state().centreView) {
      case CentreView::plan:
        plan_.draw(context);
        break;
      case CentreView::scene3d:
        scene_.draw(context);
        break;
      case CentreView::accuracy:
        accuracy_.draw(context);
        break;
    }
  }
  endPane();
}

}  // namespace acentric::editor
