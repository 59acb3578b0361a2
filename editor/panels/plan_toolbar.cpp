#include "editor/panels/plan_toolbar.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "editor/commands/density_edits.h"
#include "editor/panels/toolbar_flow.h"
#include "ui/text_format.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

const char* nameOf(PlanOverlay overlay) {
  switch (overlay) {
    case PlanOverlay::none:
      return trLater("none");
    case PlanOverlay::bake:
      return trLater("bake state");
    case PlanOverlay::triangles:
      return trLater("triangles");
    case PlanOverlay::bytes:
      return trLater("bytes");
    case PlanOverlay::checks:
      return trLater("checks");
    case PlanOverlay::density:
      return trLater("density");
    case PlanOverlay::coverage:
      break;
  }
  return trLater("coverage");
}

void drawOverlayMenu(PanelContext& context) {
  static constexpr std::array<std::pair<const char*, PlanOverlay>, 7> kOverlays{
      {{"overlay.bake", PlanOverlay::bake},
       {"view.triangles", PlanOverlay::triangles},
       {"overlay.bytes", PlanOverlay::bytes},
       {"view.checks", PlanOverlay::checks},
       {"view.coverage", PlanOverlay::coverage},
       {"overlay.density", PlanOverlay::density},
       {"overlay.none", PlanOverlay::none}}};
  EditorState& state = context.state();
  float comboWidth = ui::scaled(176);
  for (const auto& [id, overlay] : kOverlays)
    comboWidth = std::max(comboWidth, ImGui::CalcTextSize(trf("Overlay: {}", tr(nameOf(overlay))).c_str()).x +
                                          ImGui::GetFrameHeight() + 3 * ImGui::GetStyle().FramePadding.x);
  flow(comboWidth, kApart);
  ImGui::SetNextItemWidth(comboWidth);
  const std::string shown = trf("Overlay: {}", tr(nameOf(state.overlay)));
  const bool open = [&] {
    const AsTallAsIcons tall(context);
    return ImGui::BeginCombo("##overlay", shown.c_str(), ImGuiComboFlags_HeightLarge);
  }();
  context.log.item("overlay");
  if (!open)
    return ui::tooltip(tr("What the colours of the cells tell. One at a time; T, P and V are keys for it."));
  for (const auto& [id, overlay] : kOverlays) {
    const Action* action = findAction(context.table, std::string(id));
    if (action == nullptr) continue;
    std::string label = tr(nameOf(overlay));
    if (const std::string key = describe(action->shortcut); !key.empty()) label += "   [" + key + "]";
    const std::string why = whyDisabled(*action, context.actions);
    const auto flags = why.empty() ? ImGuiSelectableFlags_None : ImGuiSelectableFlags_Disabled;
    if (ImGui::Selectable(label.c_str(), state.overlay == overlay, flags) && state.overlay != overlay)
      runAction(context, *action);
    context.log.item(std::string("overlay.") + nameOf(overlay));
    ui::tooltip(why.empty() ? tr(action->help) : tr(action->help) + "\n" + trf("Not now: {}", why));
  }
  ImGui::EndCombo();
}

void drawCoverageRow(PanelContext& context) {
  ImGui::AlignTextToFramePadding();
  ui::mutedText(tr("Coverage of"));
  for (const auto& [id, label] :
       {std::pair("coverage.surfaces", tr("surfaces")), std::pair("coverage.layout", tr("the plan")),
        std::pair("coverage.cell", tr("a cell"))}) {
    ImGui::SameLine(0, id == std::string_view("coverage.surfaces") ? ui::scaled(10) : ui::scaled(kNear));
    actionButton(context, id, ButtonLook::toggle, {}, label);
  }
}

void drawOutlineRow(PanelContext& context) {
  const Outline& outline = context.session().project().layout().outline;
  ImGui::AlignTextToFramePadding();
  ui::mutedText(outline.empty() ? std::string(tr("No outline"))
                                : trf("Outline of {}", ui::formatArea(outline.area())));
  ImGui::SameLine(0, ui::scaled(10));
  actionButton(context, "outline.fromScene", ButtonLook::plain, {}, tr("From the scene"));
  ImGui::SameLine(0, ui::scaled(kNear));
  actionButton(context, "outline.simplify", ButtonLook::plain, {}, tr("Simplify within"));
  ImGui::SameLine(0, ui::scaled(kNear));
  ImGui::SetNextItemWidth(ui::scaled(70));
  const float speed = 0.002F;
  auto metres = float(context.state().simplifyMetres);
  if (ImGui::DragFloat("##simplify", &metres, speed, 0.001F, 10, "%.3f m", ImGuiSliderFlags_AlwaysClamp))
    context.state().simplifyMetres = double(metres);
  context.log.item("outline.tolerance");
  ImGui::SameLine(0, ui::scaled(kNear));
  actionButton(context, "outline.clear", ButtonLook::plain, {}, tr("Clear"));
}

}  // namespace

void drawDensityRow(PanelContext& context) {
  if (context.state().planTool.mode() != PlanMode::density) return;
  ImGui::AlignTextToFramePadding();
  ui::mutedText(tr("Samples per degree, times the project's"));
  double& chosen = context.state().densityBrush;
  for (double brush = kLeastRegionDensity;; brush = densityAfter(brush, 1)) {
    ImGui::SameLine(0, brush == kLeastRegionDensity ? ui::scaled(10) : ui::scaled(kNear));
    const std::string label = densityText(brush);
    if (ui::toggleButton(label.c_str(), densityText(chosen) == label)) chosen = brush;
    context.log.item("density.brush." + label);
    ui::tooltip(trf("{:.2g} times the bytes", brush * brush));
    if (brush >= kMostRegionDensity) break;
  }
}

void drawPlanTools(PanelContext& context) {
  using enum ButtonLook;
  static constexpr ToolbarEntry kTools[] = {
      {"tool.eye", trLater("Eye"), ui::Icon::person, kNear, tool},
      {"tool.outline", trLater("Outline"), ui::Icon::corners, kNear, tool},
      {"tool.panorama", trLater("APV"), ui::Icon::bullseye, kNear, tool},
      {"tool.lattice", trLater("Lattice"), ui::Icon::arrows, kNear, tool},
      {"tool.measure", trLater("Measure"), ui::Icon::arrowsAcross, kNear, tool},
      {"tool.path", trLater("Path"), ui::Icon::road, kNear, tool},
      {"tool.density", trLater("Density"), ui::Icon::brush, kNear, tool}};
  toolbar(context, kTools);
}

void drawPlanToolbar(PanelContext& context) {
  using enum ButtonLook;
  static constexpr ToolbarEntry kFirst[] = {{"tool.cells", trLater("Cells"), ui::Icon::pointer, 0, tool}};
  static constexpr ToolbarEntry kShown[] = {
      {"view.backdrop", trLater("Scene"), ui::Icon::picture, kApart},
      {"view.lattice", trLater("Free cells"), ui::Icon::grid, kNear},
      {"view.cameras", trLater("Cameras"), ui::Icon::videoCamera, kNear}};
  static constexpr ToolbarEntry kView[] = {{"view.table", trLater("Regions"), ui::Icon::table, kApart},
                                           {"view.fit", trLater("Fit"), ui::Icon::expand, kNear, plain}};
  toolbar(context, kFirst);
  drawPlanTools(context);
  toolbar(context, kShown);
  drawOverlayMenu(context);
  toolbar(context, kView);
  if (context.state().overlay == PlanOverlay::coverage) drawCoverageRow(context);
  if (context.state().planTool.mode() == PlanMode::outline && context.session().hasProject())
    drawOutlineRow(context);
  drawDensityRow(context);
}

}  // namespace acentric::editor
