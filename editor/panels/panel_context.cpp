#include "editor/panels/panel_context.h"

#include <fmt/format.h>

#include "engine/base/contract.h"
#include "ui/translate.h"

namespace acentric::editor {

void runAction(PanelContext& context, const Action& action) {
  if (!action.enabled(context.actions)) return;
  context.log.event("action", action.id);
  noteUse(context.state(), action.id);
  action.run(context.actions);
  context.window.pacer().request();
}

const Action& actionOf(const PanelContext& context, const char* id) {
  const Action* action = findAction(context.table, std::string(id));
  require(action != nullptr, "a button names an action of the table");
  return *action;
}

std::string tooltipOf(const PanelContext& context, const Action& action) {
  std::string text = tr(action.label);
  if (const std::string key = describe(action.shortcut); !key.empty()) text += fmt::format("  [{}]", key);
  if (!action.help.empty()) text += "\n" + tr(action.help);
  if (const std::string why = whyDisabled(action, context.actions); !why.empty())
    text += "\n" + trf("Not now: {}", why);
  return text;
}

namespace {

bool isOn(const PanelContext& context, const Action& action) {
  return action.checked && action.checked(context.actions);
}

/// After the button.
void endButton(PanelContext& context, const Action& action, bool clicked) {
  context.log.item(action.id);
  ui::tooltip(tooltipOf(context, action));
  if (clicked) runAction(context, action);
}

}  // namespace

void actionButton(PanelContext& context, const char* id, ButtonLook look, const ImVec2& size,
                  const char* label) {
  const Action& action = actionOf(context, id);
  const std::string text = std::string(label != nullptr ? label : tr(action.label.c_str())) + "##" + id;
  const bool enabled = action.enabled(context.actions);
  bool clicked = false;
  if (look == ButtonLook::toggle || look == ButtonLook::tool) {
    ImGui::BeginDisabled(!enabled);
    clicked = ui::toggleButton(text.c_str(), isOn(context, action), size);
    ImGui::EndDisabled();
  } else if (look == ButtonLook::primary) {
    clicked = ui::primaryButton(text.c_str(), size, enabled);
  } else {
    clicked = ui::button(text.c_str(), size, enabled);
  }
  endButton(context, action, clicked);
}

void actionIcon(PanelContext& context, const char* id, ui::Icon icon, ButtonLook look, const char* word) {
  ImFont* icons = context.window.fonts().icons;
  if (icons == nullptr) return actionButton(context, id, look, {}, word);
  const Action& action = actionOf(context, id);
  const bool on = look != ButtonLook::plain && isOn(context, action);
  const ui::Pressed pressed = !on                          ? ui::Pressed::no
                              : look == ButtonLook::toggle ? ui::Pressed::shown
                                                           : ui::Pressed::chosen;
  const bool clicked =
      ui::iconButton(icons, (std::string("##") + id).c_str(), icon, pressed, action.enabled(context.actions));
  endButton(context, action, clicked);
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
