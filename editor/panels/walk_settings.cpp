#include "editor/panels/walk_settings.h"

#include <fmt/format.h>

#include <array>

#include "editor/actions/path_walk.h"
#include "editor/commands/setting_edits.h"
#include "editor/panels/preference_fields.h"
#include "editor/panels/project_field.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

constexpr const char* kPopup = "##walkSettings";
constexpr float kWidth = 344;

const char* labelOf(Renderer renderer) {
  switch (renderer) {
    case Renderer::list:
      return tr("List priority");
    case Renderer::scalar:
      return tr("Scalar reference");
    case Renderer::precise:
      return tr("Double precision");
    case Renderer::zbuffer:
      return tr("Depth buffer");
    case Renderer::gl:
      return "OpenGL";
  }
  return "";
}

const char* helpFor(Renderer renderer) {
  switch (renderer) {
    case Renderer::list:
      return tr("List priority without a depth buffer: the fast one on the processor.");
    case Renderer::scalar:
      return tr("List priority, one sample at a time: the reference.");
    case Renderer::precise:
      return tr("The reference in double precision: what floats cost.");
    case Renderer::zbuffer:
      return tr("The same splats with a depth buffer, for comparison.");
    case Renderer::gl:
      return tr("List priority on the graphics card, as patches.");
  }
  return "";
}

const char* labelOf(Reconstruction reconstruction) {
  switch (reconstruction) {
    case Reconstruction::point:
      return tr("Points");
    case Reconstruction::splat:
      return tr("Splats");
    case Reconstruction::patches:
      return tr("Patches");
  }
  return "";
}

const char* helpFor(Reconstruction reconstruction) {
  switch (reconstruction) {
    case Reconstruction::point:
      return tr("One pixel a sample: shows the sampling. The least time.");
    case Reconstruction::splat:
      return tr("Squares as large as a sample's footprint. Costs the pixels that they paint over.");
    case Reconstruction::patches:
      return tr("Surfaces drawn to their edges, colours interpolated within them.");
  }
  return "";
}

/// A list of `all` in one line; `broken`: why one cannot be chosen, empty if it can.
template <class Value, std::size_t kCount, class Broken>
std::optional<Value> chooseOf(PanelContext& context, const char* label, const char* logName,
                              const Value (&all)[kCount], Value now, Broken broken) {
  std::optional<Value> chosen;
  ImGui::AlignTextToFramePadding();
  ui::mutedText(label);
  ImGui::SameLine(ui::scaled(kLabelWidth));
  ImGui::SetNextItemWidth(-1);
  const bool open = ImGui::BeginCombo((std::string("##") + logName).c_str(), labelOf(now));
  context.log.item(logName);
  if (!open) {
    ui::tooltip(helpFor(now));
    return chosen;
  }
  for (const Value value : all) {
    const std::string problem = broken(value);
    const auto flags = problem.empty() ? ImGuiSelectableFlags_None : ImGuiSelectableFlags_Disabled;
    if (ImGui::Selectable(labelOf(value), value == now, flags)) chosen = value;
    context.log.item(std::string(logName) + "." + nameOf(value));
    ui::tooltip(problem.empty() ? helpFor(value) : problem);
  }
  ImGui::EndCombo();
  return chosen;
}

void drawRenderer(PanelContext& context, const std::string& glProblem) {
  const Project& project = context.session().project();
  ViewSettings view = project.view;
  if (const auto renderer = chooseOf(context, tr("Renderer"), "walk.renderer", kRenderers, view.renderer,
                                     [&](Renderer each) -> std::string {
                                       if (!onOpenGl(each)) return "";
                                       return view.reconstruction == Reconstruction::patches
                                                  ? glProblem
                                                  : tr("OpenGL draws patches.");
                                     })) {
    view.renderer = *renderer;
    context.session().apply(setViewSettings(project, view, tr("renderer")));
  }
  if (const auto reconstruction =
          chooseOf(context, tr("Reconstruction"), "walk.reconstruction", kReconstructions,
                   view.reconstruction, [](Reconstruction) { return ""; })) {
    view.reconstruction = *reconstruction;
    if (view.reconstruction != Reconstruction::patches) view.renderer = withoutOpenGl(view.renderer);
    context.session().apply(setViewSettings(project, view, tr("reconstruction")));
  }
}

/// Of the walk now; captures are baked for the range around the layout's.
void drawEyeHeight(PanelContext& context) {
  Walker& walker = context.state().walker;
  WalkPose pose = walker.pose();
  const OpenProject& open = *context.session().built();
  const EyeHeights heights = eyeHeights(open, glm::dvec2(pose.eye));
  const double floor = footingOf(open, glm::dvec2(pose.eye)).ground;
  double height = pose.eye.z - floor;
  const std::string help = heights.high > heights.low
                               ? trf("Page Up and Page Down too. Captures are baked for {:.2f} to {:.2f} m.",
                                     heights.low - floor, heights.high - floor)
                           : context.session().shippedWalk()
                               ? tr("A walk is looked at from the height of its captures.")
                               : tr("Captures are baked for this height alone; an eye range (Bake "
                                    "quality, Advanced) makes it a choice.");
  ImGui::BeginDisabled(heights.high <= heights.low);
  const ui::FieldEdit edit =
      ui::numberField({tr("Eye above floor"), "%.2f m", 0.002, heights.low - floor, heights.high - floor, ""},
                      height, kLabelWidth);
  ImGui::EndDisabled();
  context.log.item("walk.eyeHeight");
  ui::tooltip(help);
  if (heights.high <= heights.low && !context.session().shippedWalk()) {
    ImGui::SetCursorPosX(ui::scaled(kLabelWidth));
    if (ui::button(tr("Set an eye range…"))) {
      runAction(context, *findAction(context.table, std::string("settings.advancedBake")));
      ImGui::CloseCurrentPopup();
    }
    context.log.item("walk.eyeRange");
  }
  if (!edit.changed) return;
  pose.eye.z = floor + height;
  walker.setPose(pose);
}

void drawWalking(PanelContext& context) {
  const Project& project = context.session().project();
  number(context, "fov", {tr("Field of view"), "%.0f°", 0.2, 10, 150, tr("Horizontal.")}, project.fovDegrees,
         [&](double v) { return setFieldOfView(project, v); });
  ImGui::BeginDisabled(context.session().shippedWalk() != nullptr);  // its colours are as they are shown
  number(context, "exposure",
         {tr("Exposure"), "%.3g", double(project.exposure) * 0.01, 1e-6, 1e6,
          tr("Brightness; nothing is baked anew.")},
         double(project.exposure), [&](double v) { return setExposure(project, float(v)); });
  ImGui::EndDisabled();
  drawEyeHeight(context);
  walkSpeedField(context, kLabelWidth);
  context.log.item("walk.speed");
  walkMemoryField(context, kLabelWidth);
}

void drawPainting(PanelContext& context) {
  const Project& project = context.session().project();
  ViewSettings view = project.view;
  const auto apply = [&](const ui::FieldEdit& edit, const char* what) {
    if (edit) applyFieldEdit(context, edit, setViewSettings(project, view, what));
  };
  apply(ui::numberField({tr("Largest splat"), "%.0f px", 0.1, 1, 64,
                         tr("Smaller: sharper edges, more holes near walls.")},
                        view.maxSplatPixels, kLabelWidth),
        tr("largest splat"));
  const auto check = [&](const char* label, bool ViewSettings::*member, const char* help) {
    bool value = view.*member;
    const ui::FieldEdit edit = ui::checkField(label, value, kLabelWidth, help);
    view.*member = value;
    apply(edit, label);
  };
  check(tr("Near geometry"), &ViewSettings::localGeometry,
        tr("Polygons within the near band, over the captures."));
  check(tr("Other hand behind"), &ViewSettings::secondaryCover,
        tr("In rings: the other ring's samples fill what the first leaves open."));
  check(tr("Fill holes"), &ViewSettings::fillHoles, tr("By guesswork; still counted as holes."));
}

}  // namespace

void drawWalkSettingsButton(PanelContext& context, const ToolbarEntry& entry, const std::string& glProblem) {
  ImFont* icons = context.window.fonts().icons;
  const bool clicked = icons != nullptr ? ui::iconButton(icons, "##walkSettingsButton", entry.icon)
                                        : ui::button(tr(entry.word));
  if (clicked) ImGui::OpenPopup(kPopup);
  context.log.item("walk.settings");
  ui::tooltip(tr("Settings of the walk\nRenderer, field of view, eye height, speed"));
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const float right = ImGui::GetIO().DisplaySize.x - 8;
  ImGui::SetNextWindowPos({std::min(low.x, right - ui::scaled(kWidth)), high.y + 4});
  ImGui::SetNextWindowSize({ui::scaled(kWidth), 0});
  if (!ImGui::BeginPopup(kPopup)) return;
  drawRenderer(context, glProblem);
  if (context.session().built()) drawWalking(context);
  ImGui::Separator();
  drawPainting(context);
  ImGui::EndPopup();
}

}  // namespace acentric::editor
