#include "editor/panels/array_panel.h"

#include <fmt/format.h>

#include "ui/translate.h"

namespace acentric::editor {
namespace {

void row(PanelContext& context, const char* label, const char* name, int& count, int& every) {
  ImGui::AlignTextToFramePadding();
  ui::mutedText(label);
  ImGui::SameLine(84);
  ImGui::SetNextItemWidth(92);
  ImGui::InputInt((std::string("##count") + name).c_str(), &count);
  context.log.item(std::string("array.count") + name);
  count = std::clamp(count, 1, 200);
  ImGui::SameLine();
  ui::mutedText(tr("every"));
  ImGui::SameLine();
  ImGui::SetNextItemWidth(92);
  ImGui::InputInt((std::string("##every") + name).c_str(), &every);
  context.log.item(std::string("array.every") + name);
  every = std::clamp(every, -1000, 1000);
}

}  // namespace

ImVec2 drawArrayPanel(PanelContext& context, const ImVec2& at, int places, int taken) {
  EditorState& state = context.state();
  ImGui::SetNextWindowPos(at);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {12, 10});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ui::palette::panel.vec());
  ImGui::Begin("Array##array", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize);
  ui::panelTitle(context.window.fonts().bold, tr("Array of the selection"));
  row(context, tr("Along 1"), "I", state.array->countI, state.array->everyI);
  row(context, tr("Along 2"), "J", state.array->countJ, state.array->everyJ);
  ui::mutedText(trf("Places: {}, taken already: {}", places, taken));
  actionButton(context, "edit.placeArray", ButtonLook::primary, {110, 0});
  ImGui::SameLine();
  const bool cancel = ui::button(tr("Cancel"), {110, 0});
  context.log.item("array.cancel");
  if (cancel) state.array.reset();
  const ImVec2 low = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
  return {low.x + size.x, low.y + size.y};
}

}  // namespace acentric::editor
