#include "editor/panels/toolbar_flow.h"

#include <algorithm>

#include "ui/widgets.h"

namespace acentric::editor {

AsTallAsIcons::AsTallAsIcons(PanelContext& context) {
  ImVec2 padding = ImGui::GetStyle().FramePadding;
  if (context.window.fonts().icons != nullptr)
    padding.y = (ui::iconButtonSize().y - ImGui::GetFontSize()) / 2;
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, padding);
}
AsTallAsIcons::~AsTallAsIcons() { ImGui::PopStyleVar(); }

void flow(float width, float gap) {
  if (gap <= 0) return;
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  ImGui::SameLine(0, ui::scaled(gap));
  if (ImGui::GetCursorPosX() + width > ImGui::GetWindowSize().x - ui::scaled(8)) return ImGui::NewLine();
  if (gap < kApart) return;
  const float x = high.x + ui::scaled(gap) / 2, in = ui::scaled(4);
  ImGui::GetWindowDrawList()->AddLine({x, low.y + in}, {x, high.y - in}, ui::palette::border.packed(),
                                      std::max(1.0F, ui::scaled(1)));
}

void flowEntry(PanelContext& context, const ToolbarEntry& entry) {
  const bool pictures = context.window.fonts().icons != nullptr;
  flow(pictures ? ui::iconButtonSize().x
                : ImGui::CalcTextSize(tr(entry.word)).x + 2 * ImGui::GetStyle().FramePadding.x,
       entry.gap);
}

void toolbar(PanelContext& context, std::span<const ToolbarEntry> entries,
             const std::function<void(const ToolbarEntry&)>& own) {
  for (const ToolbarEntry& entry : entries) {
    flowEntry(context, entry);
    if (entry.id != nullptr)
      actionIcon(context, entry.id, entry.icon, entry.look, tr(entry.word));
    else
      own(entry);
  }
}

}  // namespace acentric::editor
