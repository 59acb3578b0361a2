#include "editor/panels/settings_panel.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "editor/commands/layout_edits.h"
#include "editor/commands/setting_edits.h"
#include "editor/commands/storey_edits.h"
#include "editor/panels/bake_section.h"
#include "editor/panels/corner_section.h"
#include "editor/panels/pose_section.h"
#include "editor/panels/project_field.h"
#include "editor/panels/settings_parts.h"
#include "engine/geometry/conventions.h"
#include "ui/text_format.h"

namespace acentric::editor {
namespace {

void drawStoreyName(PanelContext& context) {
  const Project& project = context.session().project();
  ImGui::AlignTextToFramePadding();
  ui::mutedText("Name");
  ImGui::SameLine(ui::scaled(kLabelWidth));
  std::array<char, 101> name{};
  project.current().name.copy(name.data(), name.size() - 1);
  ImGui::SetNextItemWidth(-1);
  ImGui::InputText("##storeyName", name.data(), name.size());
  context.log.item("settings.storeyName");
  if (ImGui::IsItemDeactivatedAfterEdit() && project.current().name != name.data())
    context.session().apply(renameStorey(project, name.data()));
}

void drawStoreys(PanelContext& context) {
  if (!ui::section("Storey")) return;
  drawStoreyChoice(context);
  drawStoreyName(context);
  actionButton(context, "storey.find", ButtonLook::plain, {}, "Find more");
  ImGui::SameLine();
  actionButton(context, "storey.stairs", ButtonLook::plain, {}, "Stairs");
  ImGui::SameLine();
  actionButton(context, "storey.remove", ButtonLook::plain, {}, "Remove");
}

/// Floor height and origin follow from the model, so that none is the usual one.
void drawAdvancedLayout(PanelContext& context) {
  const Project& project = context.session().project();
  const LayoutSpec& spec = project.layout();
  std::vector<std::string> changed;
  if (spec.nearBand != LayoutSpec{}.nearBand) changed.emplace_back("near band");
  if (!advancedPart(context, "Layout", changed)) return;
  number(context, "floorHeight", {"Floor height", "%.3f m", 0.005, -1e6, 1e6, "Z of the walk plane."},
         spec.floorHeight, [&](double v) { return setFloorHeight(project, v); });
  number(context, "nearBand",
         {"Near band", "%.2f m", 0.01, 0, 100,
          "Geometry this far beyond a region's border is drawn as polygons. More: sharper near walls, more "
          "triangles."},
         spec.nearBand, [&](double v) { return setNearBand(project, v); });
  number(context, "originX", {"Origin x", "%.2f m", 0.01, -1e6, 1e6, "A ring's centre: shifts the lattice."},
         spec.latticeOrigin.x, [&](double v) {
           return setLatticeOrigin(project, {v, spec.latticeOrigin.y});
         });
  number(context, "originY", {"Origin y", "%.2f m", 0.01, -1e6, 1e6, "A ring's centre: shifts the lattice."},
         spec.latticeOrigin.y, [&](double v) {
           return setLatticeOrigin(project, {spec.latticeOrigin.x, v});
         });
}

void drawLayout(PanelContext& context, ConfigurationPicker& configurations) {
  if (!askedSection(context, "Layout")) return;
  configurations.draw(context, kLabelWidth);
  const Project& project = context.session().project();
  const LayoutSpec& spec = project.layout();
  number(context, "cellSize",
         {"Cell size", "%.4g m", 0.01, kLeastCellSize, kLargestCellSize,
          "Edge length of the polygons. Smaller: nearer sampling, more captures."},
         spec.cellSize, [&](double v) { return setCellSize(project, v); });
  number(context, "eyeHeight",
         {"Eye height", "%.2f m", 0.005, 0.05, 1000, "Of every capture and of the walk, above the floor."},
         spec.eyeHeight, [&](double v) { return setEyeHeight(project, v); });
  number(context, "rotation", {"Rotation", "%.1f°", 0.1, -180, 180, "Turns the lattice, counter-clockwise."},
         degrees(spec.rotationRadians), [&](double v) { return setRotation(project, radians(v)); });
  ImGui::AlignTextToFramePadding();
  ui::mutedText("Outline");
  ImGui::SameLine(ui::scaled(kLabelWidth));
  if (spec.outline.empty()) {
    ui::mutedText("none: cells only by hand");
  } else {
    ImGui::Text("%.1f m², %zu loop%s", spec.outline.area(), spec.outline.loops.size(),
                spec.outline.loops.size() == 1 ? "" : "s");
  }
  drawAdvancedLayout(context);
}

/// The panorama beside the lattice that alone is selected.
void drawPanorama(PanelContext& context) {
  const Project& project = context.session().project();
  const std::set<CellId>& selection = context.state().selection;
  if (selection.size() != 1 || selection.begin()->slot != kFreeSlot) return;
  const int key = selection.begin()->i;
  const auto found = project.layout().freeApvs.find(key);
  if (found == project.layout().freeApvs.end()) return;
  if (!ui::section(fmt::format("Panorama {}###panorama", key).c_str())) return;
  const Apv apv = found->second;
  const auto change = [&](auto set) {
    return [&, set](double v) {
      Apv changed = apv;
      set(changed, v);
      return setFreeApv(project, key, changed);
    };
  };
  const double distance = glm::length(apv.offset);
  const double azimuth = std::atan2(apv.offset.y, apv.offset.x);
  number(context, "panorama.x", {"Centre x", "%.2f m", 0.01, -1e6, 1e6}, apv.centre.x,
         change([](Apv& a, double v) { a.centre.x = v; }));
  number(context, "panorama.y", {"Centre y", "%.2f m", 0.01, -1e6, 1e6}, apv.centre.y,
         change([](Apv& a, double v) { a.centre.y = v; }));
  number(
      context, "panorama.distance",
      {"Cameras stand out", "%.2f m", 0.01, 0, 1000, "0: a traditional panorama, for the eye at its centre."},
      distance, change([azimuth](Apv& a, double v) { a.offset = v * directionOf(azimuth); }));
  number(context, "panorama.direction",
         {"First camera at", "%.1f°", 0.1, -180, 180, "Counter-clockwise from east."}, degrees(azimuth),
         change([distance](Apv& a, double v) { a.offset = distance * directionOf(radians(v)); }));
  int cameras = apv.cameraCount();
  const ui::FieldEdit edit = ui::numberField(
      {"Cameras", "%.0f", 0.05, 3, 24, "Each of 360° divided by their number."}, cameras, kLabelWidth);
  if (edit) applyFieldEdit(context, edit, change([](Apv& a, double v) { a.fovDegrees = 360 / v; })(cameras));
  const std::array<ui::Choice, 2> kHands = {ui::Choice{"Counter-clockwise", "", true, ""},
                                            ui::Choice{"Clockwise", "", true, ""}};
  int hand = apv.hand == Hand::clockwise ? 1 : 0;
  if (const ui::FieldEdit turned = ui::choiceField("Hand", kHands, hand, kLabelWidth,
                                                   "Which way round each camera looks past the polygon."))
    applyFieldEdit(context, turned, change([](Apv& a, double v) {
                     a.hand = v > 0 ? Hand::clockwise : Hand::counterClockwise;
                   })(hand));
}

void drawBudget(PanelContext& context) {
  if (!askedSection(context, "Triangle budget", false)) return;
  const Project& project = context.session().project();
  TriangleBudget budget = project.budget;
  int most = budget.trianglesPerRegion;
  const ui::FieldEdit limited =
      ui::numberField({"Per region", most == 0 ? "no limit" : "%.0f", 200, 0, 2e9,
                       "Triangles of local geometry that a region may have. 0: no limit."},
                      most, kLabelWidth);
  context.log.item("settings.budget.most");
  if (limited) {
    budget.trianglesPerRegion = most;
    applyFieldEdit(context, limited, setBudget(project, budget, "triangles per region"));
  }
  number(context, "budget.error",
         {"Largest error", "%.4f m", 0.0001, 1e-6, 10, "That simplified surfaces may lie from the scene's."},
         budget.maxErrorMetres, [&](double v) {
           budget.maxErrorMetres = v;
           return setBudget(project, budget, "largest error");
         });
  bool simplify = budget.simplify;
  if (const ui::FieldEdit edit =
          ui::checkField("Simplify", simplify, kLabelWidth,
                         "Regions above the limit are simplified to it, within the error.")) {
    budget.simplify = simplify;
    applyFieldEdit(context, edit, setBudget(project, budget, "simplify"));
  }
  actionButton(context, "budget.fit", ButtonLook::plain, {}, "Fit cells");
  ImGui::SameLine();
  actionButton(context, "budget.split", ButtonLook::plain, {}, "Split what exceeds");
}

void drawImport(PanelContext& context) {
  if (!askedSection(context, "Scene", false)) return;
  const Project& project = context.session().project();
  ui::keyValue("Model", ui::shortenPath(project.scene.string(), 30), kLabelWidth);
  ui::tooltip(project.scene.string());
  ImportOptions import = project.import;
  const std::array<ui::Choice, 3> kAxes = {ui::Choice{"By the file", "", true, ""},
                                           ui::Choice{"Y up", "", true, ""},
                                           ui::Choice{"Z up", "", true, ""}};
  int axis = int(import.up);
  if (const ui::FieldEdit edit = ui::choiceField("Up axis", kAxes, axis, kLabelWidth)) {
    import.up = UpAxis(axis);
    applyFieldEdit(context, edit, setImport(project, import, "up axis"));
  }
  double metres = import.metresPerUnit;
  // Typed, not dragged live: each value is a new import.
  ImGui::AlignTextToFramePadding();
  ui::mutedText("Metres per unit");
  ImGui::SameLine(ui::scaled(kLabelWidth));
  ImGui::SetNextItemWidth(-1);
  if (ImGui::InputDouble("##metresPerUnit", &metres, 0, 0, metres == 0 ? "by the file" : "%.6g",
                         ImGuiInputTextFlags_EnterReturnsTrue)) {
    import.metresPerUnit = metres;
    context.session().apply(setImport(project, import, "metres per unit"));
  }
  ui::tooltip("0: by the file, else guessed. Press Enter to import again.");
  bool light = import.defaultLight;
  if (const ui::FieldEdit edit = ui::checkField("Default light", light, kLabelWidth,
                                                "A sun and a sky where the file has no light.")) {
    import.defaultLight = light;
    applyFieldEdit(context, edit, setImport(project, import, "default light"));
  }
}

}  // namespace

void drawStoreyChoice(PanelContext& context) {
  const Project& project = context.session().project();
  std::vector<ui::Choice> choices;
  for (const Storey& storey : project.storeys) {
    const double floor = std::round(storey.layout.floorHeight * 100) / 100 + 0.0;  // + 0: no "-0.00"
    choices.push_back({fmt::format("{}   {:.2f} m", storey.name, floor), "", true,
                       fmt::format("{} ({:.2f} m)", storey.name, floor)});
  }
  int index = project.storey;
  const ui::FieldEdit edit =
      ui::choiceField("Storey", choices, index, kLabelWidth,
                      "The walk plane that is shown and edited, and where the walk begins.");
  context.log.item("settings.storey");
  applyFieldEdit(context, edit, showStorey(project, index));
}

void drawSettingsPanel(PanelContext& context, ConfigurationPicker& configurations) {
  ui::panelTitle(context.window.fonts().bold, "Project");
  if (!context.session().hasProject()) {
    ui::wrappedText(ui::palette::faint, "No project is open.");
    return;
  }
  drawPoseSection(context, kLabelWidth);
  drawCornerSection(context, kLabelWidth);
  drawStoreys(context);
  drawLayout(context, configurations);
  drawPanorama(context);
  drawBudget(context);
  drawBakeSection(context);
  drawEffects(context);
  drawImport(context);
  ImGui::Dummy({0, 8});
}

}  // namespace acentric::editor
