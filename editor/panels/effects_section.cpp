#include <fmt/format.h>

#include "editor/commands/setting_edits.h"
#include "editor/panels/settings_panel.h"

namespace acentric::editor {
namespace {

void drawEffect(PanelContext& context, Effect effect, const EffectState& effectState) {
  ImGui::PushID(int(effect));
  bool on = effectState.on;
  if (ui::checkBox(labelOf(effect), &on)) {
    const Project& project = context.session().project();
    const bool asCalledFor = on == effectState.calledFor;
    context.session().apply(setEffect(project, effect, asCalledFor ? std::nullopt : std::optional(on)));
  }
  ui::tooltip(effectState.reason);
  if (const EffectCosts* costs = context.session().effectCosts(); costs && effectState.on) {
    ImGui::SameLine();
    ImGui::TextDisabled("%.0f %%", 100 * costs->of(effect));
    ui::tooltip("Share of a bake's tracing and shading, measured with the last estimate.");
  }
  if (effectState.overridden) {
    ImGui::SameLine();
    ui::wrappedText(ui::palette::warning, "overridden");
  }
  ImGui::PopID();
}

}  // namespace

void drawEffects(PanelContext& context) {
  if (!ui::section("Effects", false)) return;
  const auto& built = context.session().built();
  if (!built) return;
  int notCalledFor = 0;
  for (int i = 0; i < kEffectCount; ++i) {
    const EffectState& state = built->plan[Effect(i)];
    if (!state.calledFor && !state.overridden) {
      ++notCalledFor;
      continue;
    }
    drawEffect(context, Effect(i), state);
    ImGui::Indent(ui::scaled(24));
    ui::wrappedText(ui::palette::faint, state.reason);
    ImGui::Unindent(ui::scaled(24));
  }
  if (notCalledFor == 0) return;
  if (ImGui::TreeNode("##others", "%d not called for by this scene", notCalledFor)) {
    for (int i = 0; i < kEffectCount; ++i) {
      const EffectState& state = built->plan[Effect(i)];
      if (!state.calledFor && !state.overridden) drawEffect(context, Effect(i), state);
    }
    ImGui::TreePop();
  }
}

}  // namespace acentric::editor
