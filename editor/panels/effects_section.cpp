#include <fmt/format.h>

#include <array>

#include "editor/commands/setting_edits.h"
#include "editor/panels/project_field.h"
#include "editor/panels/settings_panel.h"
#include "editor/session/engine_texts.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

void drawEffect(PanelContext& context, Effect effect, const EffectState& effectState) {
  ImGui::PushID(int(effect));
  bool on = effectState.on;
  if (ui::checkBox(tr(labelOf(effect)), &on)) {
    const Project& project = context.session().project();
    const bool asCalledFor = on == effectState.calledFor;
    context.session().apply(setEffect(project, effect, asCalledFor ? std::nullopt : std::optional(on)));
  }
  ui::tooltip(engineText(effectState.reason));
  if (const EffectCosts* costs = context.session().effectCosts(); costs && effectState.on) {
    ImGui::SameLine();
    ImGui::TextDisabled("%.0f %%", 100 * costs->of(effect));
    ui::tooltip(tr("Share of a bake's tracing and shading, measured with the last estimate."));
  }
  if (effectState.overridden) {
    ImGui::SameLine();
    ui::wrappedText(ui::palette::warning, tr("overridden"));
  }
  ImGui::PopID();
}

/// What import made of the light, as it says itself.
void drawWhy(const Scene& scene) {
  for (const std::string& line : scene.report.guessed)
    if (line.starts_with("light: ")) ui::wrappedText(ui::palette::faint, line);
}

void drawLighting(PanelContext& context, const Scene& scene) {
  const Project& project = context.session().project();
  const std::array<ui::Choice, 3> kLightings = {
      ui::Choice{tr("Guessed"), tr("By the file's materials, textures and meshes"), true, ""},
      ui::Choice{tr("In the textures"),
                 tr("Surfaces are shown as they are, as of a photographed or scanned place"), true, ""},
      ui::Choice{tr("Computed"), tr("Lamps, sun and sky light all surfaces"), true, ""}};
  int lighting = int(project.import.lighting);
  const ui::FieldEdit edit = ui::choiceField(tr("Light"), kLightings, lighting, kLabelWidth,
                                             tr("Where the light on surfaces comes from"));
  context.log.item("effects.lighting");
  if (edit) {
    ImportOptions import = project.import;
    import.lighting = Lighting(lighting);
    applyFieldEdit(context, edit, setImport(project, import, tr("light")));
  }
  drawWhy(scene);
}

}  // namespace

void drawEffects(PanelContext& context) {
  if (!ui::section(tr("Effects"), false)) return;
  const auto& built = context.session().built();
  if (!built) return;
  drawLighting(context, *built->scene);
  int notCalledFor = 0;
  for (int i = 0; i < kEffectCount; ++i) {
    const EffectState& state = built->plan[Effect(i)];
    if (!state.calledFor && !state.overridden) {
      ++notCalledFor;
      continue;
    }
    drawEffect(context, Effect(i), state);
    ImGui::Indent(ui::scaled(24));
    ui::wrappedText(ui::palette::faint, engineText(state.reason));
    ImGui::Unindent(ui::scaled(24));
  }
  if (notCalledFor == 0) return;
  if (ImGui::TreeNode("##others", trPrintf("%d not called for by this scene"), notCalledFor)) {
    for (int i = 0; i < kEffectCount; ++i) {
      const EffectState& state = built->plan[Effect(i)];
      if (!state.calledFor && !state.overridden) drawEffect(context, Effect(i), state);
    }
    ImGui::TreePop();
  }
}

}  // namespace acentric::editor
