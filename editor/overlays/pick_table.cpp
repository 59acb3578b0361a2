#include "editor/overlays/pick_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "editor/session/engine_texts.h"
#include "engine/geometry/conventions.h"
#include "engine/measure/source_colours.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

constexpr std::size_t kMostRows = 9;
constexpr float kWidth = 356, kMargin = 12;

/// The verdict on the point, for a person.
std::string verdictOf(const PointCoverage& coverage) {
  switch (coverage.surfaceClass) {
    case SurfaceClass::unseen:
      return tr("No eye in the walkable area sees it.");
    case SurfaceClass::neverSampled:
      return tr("No capture holds it: a hole for every eye that sees it.");
    case SurfaceClass::local:
      return tr("Near geometry for every eye that sees it: no capture is needed.");
    case SurfaceClass::under:
    case SurfaceClass::fine:
    case SurfaceClass::over:
      break;
  }
  const double ratio = coverage.samplesPerMetre / coverage.pixelsPerMetre;
  const char* word = coverage.surfaceClass == SurfaceClass::under  ? tr("too few")
                     : coverage.surfaceClass == SurfaceClass::over ? tr("more than enough")
                                                                   : tr("fine");
  return trf("{:.2f} samples per pixel at the nearest eye, {:.1f} m away: {}.", ratio,
             coverage.nearestDistance, word);
}

void headline(PanelContext& context, const ScenePick& pick) {
  const Scene& scene = *pick.of->scene;
  const Mesh& mesh = scene.meshOf(pick.point.mesh);
  const glm::dvec3& at = pick.point.position;
  ImGui::PushFont(context.window.fonts().bold);
  ImGui::TextUnformatted(mesh.name.empty() ? tr("Surface") : mesh.name.c_str());
  ImGui::PopFont();
  ImGui::SameLine();
  ui::mutedText(fmt::format("x {:.2f}  y {:.2f}  z {:.2f} m", at.x, at.y, at.z));
  ui::wrappedText(ui::palette::text, verdictOf(pick.sampling.coverage));
  const PointCoverage& coverage = pick.sampling.coverage;
  if (!coverage.seenFrom.empty()) {
    std::string text = trf("Seen from {} cells", coverage.seenFrom.size());
    if (!coverage.missedFrom.empty()) text += trf(", missed by {}", coverage.missedFrom.size());
    ImGui::PushFont(context.window.fonts().small);
    ui::mutedText(text + trf("; {} of {} cameras hold it", pick.held, pick.sampling.cameras.size()));
    ImGui::PopFont();
  }
}

void number(const std::string& text) {
  ImGui::TableNextColumn();
  const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0F, room));
  ImGui::TextUnformatted(text.c_str());
}

void row(PanelContext& context, const ScenePick& pick, std::size_t n) {
  const CameraSampling& camera = pick.sampling.cameras[n];
  const Layout& layout = *pick.of->layout;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const std::string name = engineText(sourceName(layout, sourceOfCamera(camera.camera)));
  const ui::Colour ink = !camera.held    ? ui::palette::faint
                         : camera.hidden ? ui::palette::warning
                                         : ui::palette::text;
  ImGui::PushStyleColor(ImGuiCol_Text, ink.vec());
  if (ImGui::Selectable(fmt::format("{}##{}", name, n).c_str(), false, ImGuiSelectableFlags_SpanAllColumns))
    context.state().scene3d.lookThrough = placeOf(layout, camera.camera);
  context.log.item(fmt::format("pick.row.{}", n));
  ImGui::PopStyleColor();
  ui::tooltip(tr("Look through this camera"));
  ImGui::PushStyleColor(ImGuiCol_Text, ink.vec());
  number(fmt::format("{:.2f}", camera.distance));
  number(fmt::format("{:.0f}°", degrees(camera.angle)));
  number(fmt::format("{:.0f}", camera.samplesPerMetre));
  number(fmt::format("{:.1f}", camera.samplesPerDegree));
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(!camera.held ? tr("no") : camera.hidden ? tr("behind") : tr("yes"));
  ImGui::PopStyleColor();
}

void table(PanelContext& context, const ScenePick& pick) {
  const std::size_t rows = std::min(kMostRows, pick.sampling.cameras.size());
  if (rows == 0) return;
  ImGui::PushFont(context.window.fonts().small);
  if (ImGui::BeginTable("##cameras", 6, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) {
    ImGui::TableSetupColumn(tr("camera"), ImGuiTableColumnFlags_WidthStretch);
    for (const char* name : {"m", tr("angle"), tr("/m"), "/°", tr("held")}) ImGui::TableSetupColumn(name);
    ImGui::PushStyleColor(ImGuiCol_Text, ui::palette::muted.vec());
    ImGui::TableHeadersRow();
    ImGui::PopStyleColor();
    for (std::size_t n = 0; n < rows; ++n) row(context, pick, n);
    ImGui::EndTable();
  }
  std::string text = tr("samples per metre, per degree at the nearest eye");
  if (pick.sampling.cameras.size() > rows)
    text = trf("{} more   ·   ", pick.sampling.cameras.size() - rows) + text;
  ui::mutedText(text);
  ImGui::PopFont();
}

}  // namespace

std::pair<ImVec2, ImVec2> drawPickTable(PanelContext& context, const ImVec2& areaMin, const ImVec2& areaMax,
                                        const ScenePick* pick) {
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const float small = context.window.fonts().small->FontSize + 2 * ImGui::GetStyle().CellPadding.y;
  const std::size_t rows = pick == nullptr ? 0 : std::min(kMostRows, pick->sampling.cameras.size());
  const float height =
      pick == nullptr ? 2.2F * line : 5.0F * line + (rows > 0 ? float(rows + 2) * small : 0.0F);
  const float width = std::min(kWidth, areaMax.x - areaMin.x - 2 * kMargin);
  const ImVec2 low(areaMax.x - width - kMargin, areaMin.y + kMargin);
  ImGui::SetCursorScreenPos(low);
  ImGui::PushStyleColor(ImGuiCol_ChildBg, ui::palette::panel.withOpacity(0.94F).vec());
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {12, 9});
  ImGui::PushStyleVar(ImGuiStyleVar_ChildRounding, 5);
  ImGui::BeginChild("##pick", {width, std::min(height, areaMax.y - low.y - kMargin)}, true,
                    ImGuiWindowFlags_AlwaysUseWindowPadding);
  ImGui::PopStyleVar(2);
  if (pick == nullptr) {
    ui::mutedText(tr("Asking the cameras…"));
  } else {
    headline(context, *pick);
    table(context, *pick);
  }
  ImGui::EndChild();
  ImGui::PopStyleColor();
  context.log.item("pick.table");
  return {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
}

}  // namespace acentric::editor
