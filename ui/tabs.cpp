#include "ui/tabs.h"

#include <algorithm>

#include "ui/theme.h"

namespace acentric::ui {

namespace {

constexpr float kMarkGap = 6;

ImVec2 labelSize(ImFont* bold, const Tab& tab) {
  return bold->CalcTextSizeA(bold->FontSize, 1e4F, 0, tab.label);
}

float markWidth(const Tab& tab) {
  return tab.mark.empty() ? 0 : ImGui::CalcTextSize(tab.mark.c_str()).x + kMarkGap;
}

}  // namespace

float tabGap(ImFont* bold, std::span<const Tab> tabs) {
  float needed = 0;
  for (const Tab& tab : tabs) needed += labelSize(bold, tab).x + markWidth(tab);
  const float room = ImGui::GetContentRegionAvail().x - needed;
  return std::clamp(room / float(std::max<std::size_t>(1, tabs.size() - 1)), scaled(6), scaled(18));
}

bool tab(ImFont* bold, const Tab& tab, float gap) {
  if (gap > 0) ImGui::SameLine(0, gap);
  const ImVec2 text = labelSize(bold, tab);
  const float mark = markWidth(tab);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool clicked = ImGui::InvisibleButton(tab.label, {text.x + mark, text.y});
  const Colour colour = tab.open || ImGui::IsItemHovered() ? palette::text : palette::muted;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddText(bold, bold->FontSize, at, colour.packed(), tab.label);
  if (mark > 0) list.AddText({at.x + text.x + kMarkGap, at.y}, tab.markColour.packed(), tab.mark.c_str());
  const float line = at.y + text.y + ImGui::GetStyle().ItemSpacing.y - 2;
  if (tab.open)
    list.AddRectFilled({at.x, line - 1}, {at.x + text.x + mark, line + 1}, palette::accent.packed());
  return clicked;
}

void endTabs() {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddLine({at.x, at.y - 2}, {at.x + ImGui::GetContentRegionAvail().x, at.y - 2},
                                      palette::border.packed());
  ImGui::Dummy({0, 2});
}

}  // namespace acentric::ui
