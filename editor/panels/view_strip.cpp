#include "editor/panels/view_strip.h"

#include <cmath>
#include <string_view>

#include "ui/colour.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

constexpr float kStripHeight = 30, kTabPadding = 16;

/// A click shows it, a double click makes it fill the window.
void drawTab(PanelContext& context, const ViewTab& tab, bool shown, bool active) {
  const Action& action = actionOf(context, tab.id);
  const bool enabled = action.enabled(context.actions);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const char* const label = tr(tab.label);
  const ImVec2 text = ImGui::CalcTextSize(label);
  const ImVec2 size(text.x + ui::scaled(2 * kTabPadding), ui::scaled(kStripHeight));
  if (ImGui::InvisibleButton(tab.id, size) && !shown) runAction(context, action);
  if (shown && ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
    runAction(context, action);
  context.log.item(tab.id);
  const bool hovered = ImGui::IsItemHovered();
  ui::tooltip(tooltipOf(context, action));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end(at.x + size.x, at.y + size.y);
  if (shown || (hovered && enabled))
    list.AddRectFilled(at, end, (shown ? ui::palette::panel : ui::palette::raised).packed());
  if (shown && active) list.AddRectFilled(at, {end.x, at.y + ui::scaled(2)}, ui::palette::accent.packed());
  const ui::Colour& ink = !enabled ? ui::palette::faint : shown ? ui::palette::text : ui::palette::muted;
  list.AddText({at.x + ui::scaled(kTabPadding), at.y + (size.y - text.y) / 2}, ink.packed(), label);
}

/// A frame with corners that point outwards, or inwards.
void drawEnlarge(ImDrawList& list, const ImVec2& centre, bool whole, std::uint32_t ink) {
  const float half = std::round(ui::scaled(5)), arm = std::round(ui::scaled(4));
  const float thick = ui::scaled(1.4F);
  for (const float x : {-1.0F, 1.0F})
    for (const float y : {-1.0F, 1.0F}) {
      const float reach = whole ? half - arm : half;
      const ImVec2 corner(centre.x + x * reach, centre.y + y * reach);
      const float away = whole ? arm : -arm;
      list.AddLine(corner, {corner.x + x * away, corner.y}, ink, thick);
      list.AddLine(corner, {corner.x, corner.y + y * away}, ink, thick);
    }
}

void drawEnlargeButton(PanelContext& context, const char* id) {
  const Action& action = actionOf(context, id);
  const float side = ui::scaled(kStripHeight);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const std::string name = std::string("enlarge.") + id;
  if (ImGui::InvisibleButton(name.c_str(), {side, side})) runAction(context, action);
  context.log.item(name);
  const bool hovered = ImGui::IsItemHovered();
  const bool whole = context.state().whole != WholeView::none;
  ui::tooltip(std::string(whole ? tr("Back beside the other views") : tr("Fill the window with this view")) +
              "  [" + describe(action.shortcut) + "]");
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (hovered) list.AddRectFilled(at, {at.x + side, at.y + side}, ui::palette::raised.packed());
  const ui::Colour& ink = hovered ? ui::palette::text : ui::palette::muted;
  drawEnlarge(list, {at.x + side / 2, at.y + side / 2}, whole, ink.packed());
}

}  // namespace

void drawViewStrip(PanelContext& context, std::span<const ViewTab> tabs, const char* own, bool active) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = ui::scaled(kStripHeight);
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + width, at.y + height},
                                            ui::palette::backdrop.packed());
  for (const ViewTab& tab : tabs) {
    drawTab(context, tab, std::string_view(tab.id) == own, active);
    ImGui::SameLine(0, 0);
  }
  ImGui::SetCursorScreenPos({at.x + width - height, at.y});
  drawEnlargeButton(context, own);
  ImGui::SetCursorScreenPos({at.x, at.y + height});
}

}  // namespace acentric::editor
