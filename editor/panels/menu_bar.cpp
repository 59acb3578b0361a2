#include "editor/panels/menu_bar.h"

// Where the arrows are in the menu bar is not in the public interface of 1.86.
#define IMGUI_DEFINE_MATH_OPERATORS
#include <imgui_internal.h>

#include "ui/text_format.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

void drawItem(PanelContext& context, const Action& action) {
  if (action.separatorBefore) ImGui::Separator();
  std::string label = tr(action.label);
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
  if (ImGui::IsItemFocused()) context.log.item("lit." + action.id);
  const std::string why = whyDisabled(action, context.actions);
  const std::string help = tr(action.help);
  ui::tooltip(why.empty() || help.empty() ? help + why : help + " (" + why + ")");
}

void drawRecent(PanelContext& context) {
  const auto recent = context.session().preferences().recent;  // opening changes the list
  if (!ImGui::BeginMenu(tr("Open recent"), !recent.empty())) return;
  for (const std::filesystem::path& file : recent)
    if (ImGui::MenuItem(ui::shortenPath(file.string(), 70).c_str()))
      proceedAfterAsking(context.actions, {Continuation::Kind::open, file});
  ImGui::EndMenu();
}

}  // namespace

MenuBar drawMenuBar(PanelContext& context) {
  MenuBar result;
  if (!ImGui::BeginMainMenuBar()) return result;
  if (context.state().openMenus) {
    context.state().openMenus = false;
    ImGui::OpenPopup("###File");
  }
  ImGuiWindow& bar = *ImGui::GetCurrentWindow();
  for (const char* menu : {trLater("File"), trLater("Edit"), trLater("View"), trLater("Plan"),
                           trLater("Walk"), trLater("Accuracy"), trLater("Help")}) {
    const std::string id = std::string("###") + menu, shown = tr(menu);
    const ImVec2 at = ImGui::GetCursorScreenPos() - bar.Pos;
    const bool open = ImGui::BeginMenu((shown + id).c_str());
    context.log.item(std::string("menu.") + menu);
    if (!open) continue;
    // From here left and right go on, also when the menu was not opened from the bar.
    bar.NavLastIds[ImGuiNavLayer_Menu] = bar.GetID(id.c_str());
    bar.NavRectRel[ImGuiNavLayer_Menu] = ImRect(at, at + ImGui::CalcTextSize(shown.c_str()));
    for (const Action& action : context.table) {
      if (action.menu != menu) continue;
      drawItem(context, action);
      if (action.id == "file.open") drawRecent(context);
    }
    ImGui::EndMenu();
  }
  result.height = ImGui::GetWindowSize().y;
  result.focused = ImGui::IsWindowFocused();
  ImGui::EndMainMenuBar();
  return result;
}

}  // namespace acentric::editor
