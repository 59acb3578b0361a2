#include "editor/panels/bake_cameras.h"

#include <fmt/format.h>

#include <algorithm>

#include "ui/text_format.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

struct Look {
  ui::Colour colour;
  const char* text;
};

Look lookOf(const QueuedCamera& camera) {
  switch (camera.stage) {
    case CameraStage::waiting:
      return {ui::palette::faint, camera.previewed ? tr("waiting, has a preview") : tr("waiting")};
    case CameraStage::tracing:
      return {ui::palette::accent, camera.previewing ? tr("tracing a preview") : tr("tracing")};
    case CameraStage::writing:
      return {ui::palette::accent, camera.previewing ? tr("writing a preview") : tr("writing")};
    case CameraStage::done:
      return {ui::palette::good, tr("done")};
    case CameraStage::reused:
      return {ui::palette::good, tr("was there")};
    case CameraStage::failed:
      return {ui::palette::danger, tr("failed")};
  }
  return {ui::palette::faint, ""};
}

std::string timeOf(const QueuedCamera& camera) {
  if (camera.stage == CameraStage::tracing)
    return fmt::format("{:.0f} %, {}", 100 * camera.traced, ui::formatDuration(camera.seconds));
  const bool traced = camera.stage == CameraStage::writing || camera.stage == CameraStage::done;
  return traced ? ui::formatDuration(camera.seconds) : std::string();
}

void drawRow(const QueuedCamera& camera, bool severalStoreys) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(severalStoreys ? fmt::format("{} / {}", camera.storey + 1, camera.camera).c_str()
                                        : fmt::format("{}", camera.camera).c_str());
  ImGui::TableNextColumn();
  const Look look = lookOf(camera);
  ui::badge(look.colour, camera.error.empty() ? look.text : look.text + (": " + camera.error));
  ui::tooltip(camera.error);
  ImGui::TableNextColumn();
  ui::mutedText(timeOf(camera));
}

}  // namespace

void drawBakeCameras(PanelContext& context) {
  const BakeQueue& queue = context.session().bakeQueue();
  if (queue.cameras().empty()) {
    ui::wrappedText(ui::palette::faint, tr("The cameras of a bake are listed here while it runs."));
    return;
  }
  const bool severalStoreys = queue.cameras().front().storey != queue.cameras().back().storey;
  constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg;
  if (!ImGui::BeginTable("##cameras", 3, kFlags)) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn(severalStoreys ? tr("Storey / camera") : tr("Camera"),
                          ImGuiTableColumnFlags_WidthFixed, ui::scaled(severalStoreys ? 104 : 56));
  ImGui::TableSetupColumn(tr("State"), ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn(tr("Traced"), ImGuiTableColumnFlags_WidthFixed, ui::scaled(104));
  ImGui::TableHeadersRow();
  ImGuiListClipper clipper;
  clipper.Begin(int(queue.cameras().size()));
  while (clipper.Step())
    for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row)
      drawRow(queue.cameras()[std::size_t(row)], severalStoreys);
  // Follows what is traced, unless the list is being looked through.
  const float line = ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y;
  if (context.session().baking().running() && !ImGui::IsWindowHovered())
    ImGui::SetScrollY(std::max(0.0F, float(queue.current()) * line - 2 * line));
  ImGui::EndTable();
}

}  // namespace acentric::editor
