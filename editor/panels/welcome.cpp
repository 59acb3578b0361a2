#include "editor/panels/welcome.h"

#include <algorithm>

#include "ui/text_format.h"

namespace acentric::editor {
namespace {

constexpr float kWidth = 560;

void centredText(ImFont* font, const ui::Colour& colour, const char* text) {
  ImGui::PushFont(font);
  const float width = ImGui::CalcTextSize(text).x;
  ImGui::SetCursorPosX((ImGui::GetWindowSize().x - width) / 2);
  ImGui::PushStyleColor(ImGuiCol_Text, colour.vec());
  ImGui::TextUnformatted(text);
  ImGui::PopStyleColor();
  ImGui::PopFont();
}

void drawRecentFiles(PanelContext& context) {
  const auto recent = context.session().preferences().recent;  // opening changes the list
  if (recent.empty()) return;
  ImGui::Dummy({0, 18});
  const float left = (ImGui::GetWindowSize().x - kWidth) / 2;
  ImGui::SetCursorPosX(left);
  ui::mutedText("Recent projects");
  for (const std::filesystem::path& file : recent) {
    ImGui::SetCursorPosX(left);
    const std::string label = file.filename().string() + "##" + file.string();
    if (ImGui::Selectable(label.c_str(), false, 0, {kWidth, 0})) context.session().open(file);
    const std::string folder = ui::shortenPath(file.parent_path().string(), 44);
    ImGui::SameLine(left + kWidth - ImGui::CalcTextSize(folder.c_str()).x);
    ui::mutedText(folder);
  }
}

}  // namespace

void drawWelcome(PanelContext& context) {
  const ui::Fonts& fonts = context.window.fonts();
  ImGui::SetCursorPosY(std::max(20.0F, ImGui::GetWindowSize().y * 0.26F));
  centredText(fonts.title, ui::palette::text, "Open a project, or a 3D model to begin one");
  ImGui::Dummy({0, 4});
  centredText(fonts.regular, ui::palette::muted, "Acentric lays, bakes and walks acentric panorama views.");
  ImGui::Dummy({0, 16});
  constexpr float kButtonWidth = 200;
  ImGui::SetCursorPosX((ImGui::GetWindowSize().x - kButtonWidth) / 2);
  actionButton(context, "file.open", ButtonLook::primary, {kButtonWidth, 38});
  ImGui::Dummy({0, 8});
  centredText(fonts.small, ui::palette::faint,
              "or drop a file here:  .acentric.json   .glb .gltf   .obj .ply .stl .fbx .dae");
  drawRecentFiles(context);
}

}  // namespace acentric::editor
