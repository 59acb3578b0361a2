#include "editor/panels/menu_bar.h"

#include "ui/text_format.h"

namespace acentric::editor {
namespace {

void drawItem(PanelContext& context, const Action& action) {
  if (action.separatorBefore) ImGui::Separator();
  std::string label = action.label;
  const Session& session = context.session();
  if (action.id == "edit.undo" && session.hasProject() && session.history().canUndo())
    label += ": " + session.history().undoLabel();
  if (action.id == "edit.redo" && session.hasProject() && session.history().canRedo())
    label += ": " + session.history().redoLabel();
  const bool checked = action.checked && action.checked(context.actions);
  const std::string text = label + "###" + action.id;
  if (ImGui::MenuItem(text.c_str(), describe(action.shortcut).c_str(), checked,
                      action.enabled(context.actions)))
    runAction(context, action);
  context.log.item("menu." + action.id);
}

void drawRecent(PanelContext& context) {
  const auto recent = context.session().preferences().recent;  // opening changes the list
  if (!ImGui::BeginMenu("Open recent", !recent.empty())) return;
  for (const std::filesystem::path& file : recent)
    if (ImGui::MenuItem(ui::shortenPath(file.string(), 70).c_str()))
      proceedAfterAsking(context.actions, {Continuation::Kind::open, file});
  ImGui::EndMenu();
}

}  // namespace

float drawMenuBar(PanelContext& context) {
  if (!ImGui::BeginMainMenuBar()) return 0;
  for (const char* menu : {"File", "Edit", "Plan", "Walk", "Help"}) {
    const bool open = ImGui::BeginMenu(menu);
    context.log.item(std::string("menu.") + menu);
    if (!open) continue;
    for (const Action& action : context.table) {
      if (action.menu != menu) continue;
      drawItem(context, action);
      if (action.id == "file.open") drawRecent(context);
    }
    ImGui::EndMenu();
  }
  const float height = ImGui::GetWindowSize().y;
  ImGui::EndMainMenuBar();
  return height;
}

}  // namespace acentric::editor
