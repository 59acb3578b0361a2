#include "editor/panels/dialog_frame.h"

#include <algorithm>

#include "ui/translate.h"

namespace acentric::editor {

float dialogButtonWidth() { return ui::scaled(112); }

namespace {

/// What it shows may grow: downwards, so that nothing moves below the pointer, but not out of the window.
void keepInside(const ImVec2& display) {
  const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  const ImVec2 inside(std::max(0.0F, std::min(at.x, display.x - size.x)),
                      std::max(0.0F, std::min(at.y, display.y - size.y)));
  if (inside.x != at.x || inside.y != at.y) ImGui::SetWindowPos(inside);
}

}  // namespace

bool beginDialog(const char* title, float width) {
  // So that it stays open while the language changes.
  const std::string named = tr(title) + std::string("###") + title;
  const char* const id = named.c_str();
  if (!ImGui::IsPopupOpen(id)) ImGui::OpenPopup(id);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({std::min(ui::scaled(width), std::max(1.0F, display.x)), 0});
  ImGui::SetNextWindowSizeConstraints({1, 1}, {std::max(1.0F, display.x), std::max(1.0F, display.y)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ui::scaled(ImVec2(18, 14)));
  const bool open =
      ImGui::BeginPopupModal(id, nullptr, ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoResize);
  ImGui::PopStyleVar();
  if (open && !ImGui::IsWindowAppearing()) keepInside(display);
  return open;
}

void endDialog(bool close) {
  if (close) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

void alignButtons(int buttons, float width) {
  const float spacing = ImGui::GetStyle().ItemSpacing.x;
  ImGui::Dummy({0, ui::scaled(6)});
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x -
                       float(buttons) * (width > 0 ? width : dialogButtonWidth()) -
                       float(buttons - 1) * spacing);
}

}  // namespace acentric::editor
