#include "ui/splitter.h"

#include <imgui.h>

#include <algorithm>

#include "ui/colour.h"
#include "ui/theme.h"

namespace acentric::ui {

float splitterPixels() { return scaled(5); }

bool splitter(const char* id, SplitDirection direction, float length, float& size, float least, float most,
              bool sizesNext) {
  const bool horizontal = direction == SplitDirection::horizontal;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 extent = horizontal ? ImVec2(splitterPixels(), length) : ImVec2(length, splitterPixels());
  ImGui::InvisibleButton(id, extent);
  const bool active = ImGui::IsItemActive();
  const bool hovered = ImGui::IsItemHovered();
  if (active) {
    const ImVec2 delta = ImGui::GetIO().MouseDelta;
    const float change = horizontal ? delta.x : delta.y;
    size += sizesNext ? -change : change;
  }
  size = std::clamp(size, least, std::max(least, most));
  if (hovered || active)
    ImGui::SetMouseCursor(horizontal ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
  const Colour colour = active ? palette::accent : hovered ? palette::faint : palette::backdrop;
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + extent.x, at.y + extent.y}, colour.packed());
  return active;
}

}  // namespace acentric::ui
