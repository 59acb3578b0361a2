#include "editor/panels/plan_toolbar.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "editor/commands/density_edits.h"
#include "editor/panels/toolbar_flow.h"

namespace acentric::editor {
namespace {

const char* nameOf(PlanOverlay overlay) {
  switch (overlay) {
    case PlanOverlay::none:
      return "none";
    case PlanOverlay::bake:
      return "bake state";
    case PlanOverlay::triangles:
      return "triangles";
    case PlanOverlay::bytes:
      return "bytes";
    case PlanOverlay::checks:
      return "checks";
    case PlanOverlay::density:
      return "density";
    case PlanOverlay::coverage:
      break;
  }
  return "coverage";
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
  const float comboWidth = ui::scaled(176);
  flow(comboWidth, kApart);
  ImGui::SetNextItemWidth(comboWidth);
  const std::string shown = fmt::format("Overlay: {}", nameOf(state.overlay));
  const bool open = [&] {
    const AsTallAsIcons tall(context);
    return ImGui::BeginCombo("##overlay", shown.c_str(), ImGuiComboFlags_HeightLarge);
  }();
  context.log.item("overlay");
  if (!open)
    return ui::tooltip("What the colours of the cells tell. One at a time; T, P and V are keys for it.");
  for (const auto& [id, overlay] : kOverlays) {
    const Action* action = findAction(context.table, std::string(id));
    if (action == nullptr) continue;
    std::string label = nameOf(overlay);
    if (const std::string key = describe(action->shortcut); !key.empty()) label += "   [" + key + "]";
    const std::string why = whyDisabled(*action, context.actions);
    const auto flags = why.empty() ? ImGuiSelectableFlags_None : ImGuiSelectableFlags_Disabled;
    if (ImGui::Selectable(label.c_str(), state.overlay == overlay, flags) && state.overlay != overlay)
      runAction(context, *action);
    context.log.item(std::string("overlay.") + nameOf(overlay));
    ui::tooltip(why.empty() ? action->help : action->help + "\nNot now: " + why);
  }
  ImGui::EndCombo();
}

void drawCoverageRow(PanelContext& context) {
  ImGui::AlignTextToFramePadding();
  ui::mutedText("Coverage of");
  for (const auto& [id, label] :
       {std::pair("coverage.surfaces", "surfaces"), std::pair("coverage.layout", "the plan"),
        std::pair("coverage.cell", "a cell")}) {
    ImGui::SameLine(0, id == std::string_view("coverage.surfaces") ? ui::scaled(10) : ui::scaled(kNear));
    actionButton(context, id, ButtonLook::toggle, {}, label);
  }
}

void drawOutlineRow(PanelContext& context) {
  const Outline& outline = context.session().project().layout().outline;
  ImGui::AlignTextToFramePadding();
  ui::mutedText(outline.empty() ? std::string("No outline")
                                : fmt::format("Outline of {:.1f} m²", outline.area()));
  ImGui::SameLine(0, ui::scaled(10));
  actionButton(context, "outline.fromScene", ButtonLook::plain, {}, "From the scene");
  ImGui::SameLine(0, ui::scaled(kNear));
  actionButton(context, "outline.simplify", ButtonLook::plain, {}, "Simplify within");
  ImGui::SameLine(0, ui::scaled(kNear));
  ImGui::SetNextItemWidth(ui::scaled(70));
  const float speed = 0.002F;
  auto metres = float(context.state().simplifyMetres);
  if (ImGui::DragFloat("##simplify", &metres, speed, 0.001F, 10, "%.3f m", ImGuiSliderFlags_AlwaysClamp))
    context.state().simplifyMetres = double(metres);
  context.log.item("outline.tolerance");
  ImGui::SameLine(0, ui::scaled(kNear));
  actionButton(context, "outline.clear", ButtonLook::plain, {}, "Clear");
}

}  // namespace

void drawDensityRow(PanelContext& context) {
  if (context.state().planTool.mode() != PlanMode::density) return;
  ImGui::AlignTextToFramePadding();
  ui::mutedText("Samples per degree, times the project's");
  double& chosen = context.state().densityBrush;
  for (double brush = kLeastRegionDensity;; brush = densityAfter(brush, 1)) {
    ImGui::SameLine(0, brush == kLeastRegionDensity ? ui::scaled(10) : ui::scaled(kNear));
    const std::string label = densityText(brush);
    if (ui::toggleButton(label.c_str(), densityText(chosen) == label)) chosen = brush;
    context.log.item("density.brush." + label);
    ui::tooltip(fmt::format("{:.2g} times the bytes", brush * brush));
    if (brush >= kMostRegionDensity) break;
  }
}

void drawPlanToolbar(PanelContext& context) {
  using enum ButtonLook;
  static constexpr ToolbarEntry kTools[] = {{"tool.cells", "Cells", ui::Icon::pointer, 0, tool},
                                            {"tool.eye", "Eye", ui::Icon::person, kNear, tool},
                                            {"tool.outline", "Outline", ui::Icon::corners, kNear, tool},
                                            {"tool.panorama", "APV", ui::Icon::bullseye, kNear, tool},
                                            {"tool.lattice", "Lattice", ui::Icon::arrows, kNear, tool},
                                            {"tool.measure", "Measure", ui::Icon::arrowsAcross, kNear, tool},
                                            {"tool.path", "Path", ui::Icon::road, kNear, tool},
                                            {"tool.density", "Density", ui::Icon::brush, kNear, tool},
                                            {"view.backdrop", "Scene", ui::Icon::picture, kApart},
                                            {"view.lattice", "Free cells", ui::Icon::grid, kNear},
                                            {"view.cameras", "Cameras", ui::Icon::videoCamera, kNear}};
  static constexpr ToolbarEntry kView[] = {{"view.table", "Regions", ui::Icon::table, kApart},
                                           {"view.fit", "Fit", ui::Icon::expand, kNear, plain}};
  toolbar(context, kTools);
  drawOverlayMenu(context);
  toolbar(context, kView);
  if (context.state().overlay == PlanOverlay::coverage) drawCoverageRow(context);
  if (context.state().planTool.mode() == PlanMode::outline && context.session().hasProject())
    drawOutlineRow(context);
  drawDensityRow(context);
}

}  // namespace acentric::editor
