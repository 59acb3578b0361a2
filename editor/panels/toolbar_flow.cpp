#include "editor/panels/toolbar_flow.h"

#include "ui/widgets.h"

namespace acentric::editor {

void flow(float width, float gap) {
  if (gap > 0) ImGui::SameLine(0, ui::scaled(gap));
  if (ImGui::GetCursorPosX() + width > ImGui::GetWindowSize().x - ui::scaled(8)) ImGui::NewLine();
}

void flowButton(const char* label, float gap) {
  flow(ImGui::CalcTextSize(label).x + 2 * ImGui::GetStyle().FramePadding.x, gap);
}

}  // namespace acentric::editor
