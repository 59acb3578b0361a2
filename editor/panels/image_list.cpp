#include "editor/panels/image_list.h"

#include <fmt/format.h>

#include "ui/theme.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {
namespace palette = ui::palette;

constexpr float kRow = 18, kHead = 24, kListPadding = 8;

ImU32 packed(const Rgba8& colour) { return IM_COL32(colour.r, colour.g, colour.b, 255); }

/// True if the pointer is at it.
bool drawRow(PanelContext& context, int place, const UsedImage& image, const Rgba8& colour) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, row = ui::scaled(kRow);
  ImGui::InvisibleButton(fmt::format("##image{}", image.camera).c_str(), {width, row});
  context.log.item(fmt::format("walk.images.{}", image.camera));
  const bool hovered = ImGui::IsItemHovered();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (hovered) list.AddRectFilled(at, {at.x + width, at.y + row}, palette::hovered.packed(), 3);
  ImFont* font = context.window.fonts().small;
  const auto text = [&](float x, const ui::Colour& ink, const std::string& words) {
    list.AddText(font, font->FontSize, {at.x + ui::scaled(x), at.y + ui::scaled(2)}, ink.packed(),
                 words.c_str());
  };
  text(4, palette::faint, fmt::format("{}", place));
  list.AddRectFilled({at.x + ui::scaled(24), at.y + ui::scaled(4)},
                     {at.x + ui::scaled(34), at.y + ui::scaled(14)}, packed(colour), 2);
  text(41, image.state == ImageState::missing ? palette::warning : palette::text, describe(image));
  return hovered;
}

}  // namespace

float imageListHeight(std::size_t images) {
  return ui::scaled(kHead + kRow * float(std::max<std::size_t>(1, images)) + kListPadding);
}

std::optional<int> drawImageList(PanelContext& context, const ImVec2& low, const ImVec2& high,
                                 const std::vector<UsedImage>& images, const SourceColours& colours) {
  std::optional<int> pointedAt;
  context.log.rect("walk.images", low.x, low.y, high.x, high.y);
  ImGui::SetCursorScreenPos(low);
  ImGui::PushStyleColor(ImGuiCol_ChildBg, palette::backdrop.withOpacity(0.9F).vec());
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ui::scaled(ImVec2(kListPadding, 4)));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_ChildRounding, 4);
  if (ImGui::BeginChild("##images", {high.x - low.x, high.y - low.y}, false,
                        ImGuiWindowFlags_AlwaysUseWindowPadding)) {
    ImGui::PushFont(context.window.fonts().small);
    ui::mutedText(images.empty() ? tr("No image is in use.")
                                 : trf("{} images, painted in this order", images.size()));
    ImGui::PopFont();
    ImGui::Dummy({0, 3});
    int place = 0;
    for (const UsedImage& image : images)
      if (drawRow(context, ++place, image, colours.of(sourceOfCamera(image.camera))))
        pointedAt = image.camera;
  }
  ImGui::EndChild();
  ImGui::PopStyleVar(3);
  ImGui::PopStyleColor();
  return pointedAt;
}

}  // namespace acentric::editor
