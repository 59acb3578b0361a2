#include "editor/panels/panel_context.h"

#include <fmt/format.h>

#include "engine/base/contract.h"

namespace acentric::editor {

void runAction(PanelContext& context, const Action& action) {
  if (!action.enabled(context.actions)) return;
  context.log.event("action", action.id);
  noteUse(context.state(), action.id);
  action.run(context.actions);
  context.window.pacer().request();
}

void actionButton(PanelContext& context, const char* id, ButtonLook look, const ImVec2& size,
                  const char* label) {
  const Action* action = findAction(context.table, std::string(id));
  require(action != nullptr, "a button names an action of the table");
  const std::string text = std::string(label != nullptr ? label : action->label.c_str()) + "##" + id;
  const bool enabled = action->enabled(context.actions);
  bool clicked = false;
  if (look == ButtonLook::toggle) {
    ImGui::BeginDisabled(!enabled);
    clicked = ui::toggleButton(text.c_str(), action->checked && action->checked(context.actions), size);
    ImGui::EndDisabled();
  } else if (look == ButtonLook::primary) {
    clicked = ui::primaryButton(text.c_str(), size, enabled);
  } else {
    clicked = ui::button(text.c_str(), size, enabled);
  }
  context.log.item(id);
  std::string help = action->help.empty() ? action->label : action->help;
  if (const std::string key = describe(action->shortcut); !key.empty()) help += fmt::format("  [{}]", key);
  if (const std::string why = whyDisabled(*action, context.actions); !why.empty())
    help += "\nNot now: " + why;
  ui::tooltip(help);
  if (clicked) runAction(context, *action);
}

bool beginPane(const char* id, const ImVec2& size, bool padded) {
  ImGui::PushStyleColor(ImGuiCol_ChildBg, ui::palette::panel.vec());
  if (!padded) ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  const bool visible = ImGui::BeginChild(id, size, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
  if (!padded) ImGui::PopStyleVar();
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ui::scaled(ImVec2(8, 6)));
  return visible;
}

void endPane() {
  ImGui::PopStyleVar();
  ImGui::EndChild();
  ImGui::PopStyleColor();
}

void applyFieldEdit(PanelContext& context, const ui::FieldEdit& field, Edit edit) {
  if (field.changed)
    context.session().applyLive(std::move(edit), field.finished);
  else if (field.finished)
    context.session().finishLive();
}

}  // namespace acentric::editor
