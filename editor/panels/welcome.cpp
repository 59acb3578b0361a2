#include "editor/panels/welcome.h"

#include <algorithm>

#include "ui/text_format.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

float listWidth() { return ui::scaled(560); }

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
  ImGui::Dummy({0, ui::scaled(18)});
  const float left = (ImGui::GetWindowSize().x - listWidth()) / 2;
  ImGui::SetCursorPosX(left);
  ui::mutedText(tr("Recent projects and walks"));
  for (const std::filesystem::path& file : recent) {
    ImGui::SetCursorPosX(left);
    const std::string label = file.filename().string() + "##" + file.string();
    if (ImGui::Selectable(label.c_str(), false, 0, {listWidth(), 0})) context.session().open(file);
    const std::string folder = ui::shortenPath(file.parent_path().string(), 44);
    ImGui::SameLine(left + listWidth() - ImGui::CalcTextSize(folder.c_str()).x);
    ui::mutedText(folder);
  }
}

/// What crashed runs had not saved anywhere.
void drawUnsavedWork(PanelContext& context) {
  const std::vector<UnsavedWork> works = context.session().unsavedWork();  // opening changes the list
  if (works.empty()) return;
  ImGui::Dummy({0, 18});
  const float left = (ImGui::GetWindowSize().x - listWidth()) / 2;
  ImGui::SetCursorPosX(left);
  ui::mutedText(tr("Not saved when the last run ended"));
  for (std::size_t i = 0; i < works.size(); ++i) {
    ImGui::SetCursorPosX(left);
    const std::string label = works[i].projectFile.filename().string() + "##" + works[i].autosave.string();
    ImGui::PushStyleColor(ImGuiCol_Text, ui::palette::warning.vec());
    const bool clicked = ImGui::Selectable(label.c_str(), false, 0, {listWidth(), 0});
    ImGui::PopStyleColor();
    context.log.item("welcome.unsaved." + std::to_string(i));
    if (clicked) context.session().open(works[i].autosave);
    const std::string when = trf("as of {}", works[i].since);
    ImGui::SameLine(left + listWidth() - ImGui::CalcTextSize(when.c_str()).x);
    ui::mutedText(when);
  }
}

}  // namespace

void drawWelcome(PanelContext& context) {
  const ui::Fonts& fonts = context.window.fonts();
  ImGui::SetCursorPosY(std::max(20.0F, ImGui::GetWindowSize().y * 0.26F));
  centredText(fonts.title, ui::palette::text,
              tr("Open a project or a walk, or a 3D model to begin a project"));
  ImGui::Dummy({0, 4});
  centredText(fonts.regular, ui::palette::muted,
              tr("Acentric lays, bakes and walks acentric panorama views."));
  ImGui::Dummy({0, ui::scaled(16)});
  const ImVec2 button = ui::scaled(ImVec2(200, 38));
  const float gap = ui::scaled(10);
  ImGui::SetCursorPosX((ImGui::GetWindowSize().x - 2 * button.x - gap) / 2);
  actionButton(context, "file.open", ButtonLook::primary, button);
  ImGui::SameLine(0, gap);
  actionButton(context, "file.new", ButtonLook::plain, button);
  ImGui::Dummy({0, 8});
  centredText(fonts.small, ui::palette::faint,
              tr("or drop a file here:  .acentric.json   .acentric   .glb .gltf   .obj .ply .stl .fbx .dae"));
  drawUnsavedWork(context);
  drawRecentFiles(context);
}

}  // namespace acentric::editor
