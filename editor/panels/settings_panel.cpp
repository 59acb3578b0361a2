#include "editor/panels/settings_panel.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "editor/commands/layout_edits.h"
#include "editor/commands/setting_edits.h"
#include "editor/commands/storey_edits.h"
#include "editor/panels/bake_section.h"
#include "editor/panels/corner_section.h"
#include "editor/panels/import_fields.h"
#include "editor/panels/pose_section.h"
#include "editor/panels/project_field.h"
#include "editor/panels/settings_parts.h"
#include "engine/geometry/conventions.h"
#include "ui/text_format.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

void drawStoreyName(PanelContext& context) {
  const Project& project = context.session().project();
  ImGui::AlignTextToFramePadding();
  ui::mutedText(tr("Name"));
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
  if (!ui::section(tr("Storey"))) return;
  drawStoreyChoice(context);
  drawStoreyName(context);
  actionButton(context, "storey.find", ButtonLook::plain, {}, tr("Find more"));
  ImGui::SameLine();
  actionButton(context, "storey.stairs", ButtonLook::plain, {}, tr("Stairs"));
  ImGui::SameLine();
  actionButton(context, "storey.remove", ButtonLook::plain, {}, tr("Remove"));
}

/// Floor height and origin follow from the model, so that none is the usual one.
void drawAdvancedLayout(PanelContext& context) {
  const Project& project = context.session().project();
  const LayoutSpec& spec = project.layout();
  std::vector<std::string> changed;
  if (spec.nearBand != LayoutSpec{}.nearBand) changed.emplace_back(trLater("near band"));
  if (!advancedPart(context, trLater("Layout"), changed)) return;
  number(context, "floorHeight", {tr("Floor height"), "%.3f m", 0.005, -1e6, 1e6, tr("Z of the walk plane.")},
         spec.floorHeight, [&](double v) { return setFloorHeight(project, v); });
  number(
      context, "nearBand",
      {tr("Near band"), "%.2f m", 0.01, 0, 100,
       tr("Geometry this far beyond a region's border is drawn as polygons. More: sharper near walls, more "
          "triangles.")},
      spec.nearBand, [&](double v) { return setNearBand(project, v); });
  number(context, "originX",
         {tr("Origin x"), "%.2f m", 0.01, -1e6, 1e6, tr("A ring's centre: shifts the lattice.")},
         spec.latticeOrigin.x, [&](double v) {
           return setLatticeOrigin(project, {v, spec.latticeOrigin.y});
         });
  number(context, "originY",
         {tr("Origin y"), "%.2f m", 0.01, -1e6, 1e6, tr("A ring's centre: shifts the lattice.")},
         spec.latticeOrigin.y, [&](double v) {
           return setLatticeOrigin(project, {spec.latticeOrigin.x, v});
         });
}

void drawLayout(PanelContext& context, ConfigurationPicker& configurations) {
  if (!askedSection(context, trLater("Layout"))) return;
  configurations.draw(context, kLabelWidth);
  const Project& project = context.session().project();
  const LayoutSpec& spec = project.layout();
  number(context, "cellSize",
         {tr("Cell size"), "%.4g m", 0.01, kLeastCellSize, kLargestCellSize,
          tr("Edge length of the polygons. Smaller: nearer sampling, more captures.")},
         spec.cellSize, [&](double v) { return setCellSize(project, v); });
  number(context, "eyeHeight",
         {tr("Eye height"), "%.2f m", 0.005, 0.05, 1000,
          tr("Of every capture and of the walk, above the floor.")},
         spec.eyeHeight, [&](double v) { return setEyeHeight(project, v); });
  number(context, "rotation",
         {tr("Rotation"), "%.1f°", 0.1, -180, 180, tr("Turns the lattice, counter-clockwise.")},
         degrees(spec.rotationRadians), [&](double v) { return setRotation(project, radians(v)); });
  ImGui::AlignTextToFramePadding();
  ui::mutedText(tr("Outline"));
  ImGui::SameLine(ui::scaled(kLabelWidth));
  if (spec.outline.empty()) {
    ui::mutedText(tr("none: cells only by hand"));
  } else {
    ImGui::TextUnformatted(trfMany("{}, {} loop", "{}, {} loops", spec.outline.loops.size(),
                                   ui::formatArea(spec.outline.area()), spec.outline.loops.size())
                               .c_str());
    actionButton(context, "layout.fit", ButtonLook::plain, {});
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
  if (!ui::section(trf("Panorama {}###panorama", key).c_str())) return;
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
  number(context, "panorama.x", {tr("Centre x"), "%.2f m", 0.01, -1e6, 1e6}, apv.centre.x,
         change([](Apv& a, double v) { a.centre.x = v; }));
  number(context, "panorama.y", {tr("Centre y"), "%.2f m", 0.01, -1e6, 1e6}, apv.centre.y,
         change([](Apv& a, double v) { a.centre.y = v; }));
  number(context, "panorama.distance",
         {tr("Cameras stand out"), "%.2f m", 0.01, 0, 1000,
          tr("0: a traditional panorama, for the eye at its centre.")},
         distance, change([azimuth](Apv& a, double v) { a.offset = v * directionOf(azimuth); }));
  number(context, "panorama.direction",
         {tr("First camera at"), "%.1f°", 0.1, -180, 180, tr("Counter-clockwise from east.")},
         degrees(azimuth),
         change([distance](Apv& a, double v) { a.offset = distance * directionOf(radians(v)); }));
  int cameras = apv.cameraCount();
  const ui::FieldEdit edit =
      ui::numberField({tr("Cameras"), "%.0f", 0.05, 3, 24, tr("Each of 360° divided by their number.")},
                      cameras, kLabelWidth);
  if (edit) applyFieldEdit(context, edit, change([](Apv& a, double v) { a.fovDegrees = 360 / v; })(cameras));
  const std::array<ui::Choice, 2> kHands = {ui::Choice{tr("Counter-clockwise"), "", true, ""},
                                            ui::Choice{tr("Clockwise"), "", true, ""}};
  int hand = apv.hand == Hand::clockwise ? 1 : 0;
  if (const ui::FieldEdit turned = ui::choiceField(tr("Hand"), kHands, hand, kLabelWidth,
                                                   tr("Which way round each camera looks past the polygon.")))
    applyFieldEdit(context, turned, change([](Apv& a, double v) {
                     a.hand = v > 0 ? Hand::clockwise : Hand::counterClockwise;
                   })(hand));
}

void drawBudget(PanelContext& context) {
  if (!askedSection(context, trLater("Triangle budget"), false)) return;
  const Project& project = context.session().project();
  TriangleBudget budget = project.budget;
  int most = budget.trianglesPerRegion;
  const ui::FieldEdit limited =
      ui::numberField({tr("Per region"), most == 0 ? trPrintf("no limit") : "%.0f", 200, 0, 2e9,
                       tr("Triangles of local geometry that a region may have. 0: no limit.")},
                      most, kLabelWidth);
  context.log.item("settings.budget.most");
  if (limited) {
    budget.trianglesPerRegion = most;
    applyFieldEdit(context, limited, setBudget(project, budget, tr("triangles per region")));
  }
  number(context, "budget.error",
         {tr("Largest error"), "%.4f m", 0.0001, 1e-6, 10,
          tr("That simplified surfaces may lie from the scene's.")},
         budget.maxErrorMetres, [&](double v) {
           budget.maxErrorMetres = v;
           return setBudget(project, budget, tr("largest error"));
         });
  bool simplify = budget.simplify;
  if (const ui::FieldEdit edit =
          ui::checkField(tr("Simplify"), simplify, kLabelWidth,
                         tr("Regions above the limit are simplified to it, within the error."))) {
    budget.simplify = simplify;
    applyFieldEdit(context, edit, setBudget(project, budget, tr("simplify")));
  }
  actionButton(context, "budget.fit", ButtonLook::plain, {}, tr("Fit cells"));
  ImGui::SameLine();
  actionButton(context, "budget.split", ButtonLook::plain, {}, tr("Split what exceeds"));
}

void drawImport(PanelContext& context) {
  if (!askedSection(context, trLater("Scene"), false)) return;
  const Project& project = context.session().project();
  ui::keyValue(tr("Model"), ui::shortenPath(project.scene.string(), 30), kLabelWidth);
  ui::tooltip(project.scene.string());
  ImportOptions import = project.import;
  if (const ui::FieldEdit edit = upAxisField(import.up, kLabelWidth))
    applyFieldEdit(context, edit, setImport(project, import, tr("up axis")));
  if (metresPerUnitField(import.metresPerUnit, kLabelWidth))
    context.session().apply(setImport(project, import, tr("metres per unit")));
  bool light = import.defaultLight;
  if (const ui::FieldEdit edit = ui::checkField(tr("Default light"), light, kLabelWidth,
                                                tr("A sun and a sky where the file has no light."))) {
    import.defaultLight = light;
    applyFieldEdit(context, edit, setImport(project, import, tr("default light")));
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
      ui::choiceField(tr("Storey"), choices, index, kLabelWidth,
                      tr("The walk plane that is shown and edited, and where the walk begins."));
  context.log.item("settings.storey");
  applyFieldEdit(context, edit, showStorey(project, index));
}

void drawSettingsPanel(PanelContext& context, ConfigurationPicker& configurations) {
  ui::panelTitle(context.window.fonts().bold, tr("Project"));
  if (!context.session().hasProject()) {
    ui::wrappedText(ui::palette::faint, tr("No project is open."));
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
