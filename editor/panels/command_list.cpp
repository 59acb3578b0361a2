#include "editor/panels/command_list.h"

#include <algorithm>
#include <utility>

#include "editor/actions/action_search.h"
#include "ui/keys.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

constexpr const char* kPopup = "##commandList";
constexpr int kPage = 10;

/// Text at the right border of the line that was drawn last.
void rightText(const ui::Colour& colour, const std::string& text) {
  const float width = ImGui::CalcTextSize(text.c_str()).x;
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - width - ui::scaled(6));
  ImGui::PushStyleColor(ImGuiCol_Text, colour.vec());
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
}

}  // namespace

bool CommandList::handleKey(const ui::InputEvent& event) {
  if (!shown_ ||
      (event.kind != ui::InputEvent::Kind::keyPress && event.kind != ui::InputEvent::Kind::keyRepeat))
    return false;
  namespace key = ui::key;
  switch (event.code) {
    case key::down:
      ++steps_;
      return true;
    case key::up:
      --steps_;
      return true;
    case key::pageDown:
      steps_ += kPage;
      return true;
    case key::pageUp:
      steps_ -= kPage;
      return true;
    case key::enter:
    case key::keypadEnter:
      enter_ = true;
      return true;
    case key::escape:
      escape_ = true;
      return true;
    default:
      return true;  // no shortcut while a name is typed
  }
}

void CommandList::begin() {
  query_.clear();
  selected_ = steps_ = 0;
  enter_ = escape_ = false;
  shown_ = true;
  field_.begin();
  ImGui::OpenPopup(kPopup);
}

/// True if what is sought changed.
bool CommandList::drawField(const char* hint, ui::UiLog& log) {
  const bool changed = field_.draw(hint, query_);
  log.item("commands.query");
  ImGui::Dummy({0, ui::scaled(2)});
  return changed;
}

void CommandList::drawCommands(PanelContext& context) {
  if (drawField(tr("Find a command: letters of its name, menu or key"), context.log)) selected_ = 0;
  const auto found = searchActions(context.table, query_, context.state().recentActions);
  const int moved = std::exchange(steps_, 0);
  scroll_ = moved != 0;
  selected_ = std::clamp(selected_ + moved, 0, std::max(0, int(found.size()) - 1));
  const Action* run = nullptr;
  const float help = 2 * ImGui::GetTextLineHeightWithSpacing() + ui::scaled(8);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ui::scaled(ImVec2(8, 2)));
  ImGui::BeginChild("##found", {0, -help}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
  ImGui::PopStyleVar();
  for (int row = 0; row < int(found.size()); ++row) {
    const Action& action = *found[std::size_t(row)];
    const std::string why = whyDisabled(action, context.actions);
    ImGui::PushStyleColor(ImGuiCol_Text, (why.empty() ? ui::palette::text : ui::palette::faint).vec());
    if (ImGui::Selectable((tr(action.label) + "##" + action.id).c_str(), row == selected_)) run = &action;
    ImGui::PopStyleColor();
    context.log.item("command." + action.id);
    if (row == selected_ && scroll_) ImGui::SetScrollHereY();
    if (ImGui::IsItemHovered() && ImGui::GetIO().MouseDelta.y != 0) selected_ = row;
    const std::string menu = tr(menuOf(action));
    ImGui::SameLine(ImGui::GetWindowWidth() * 0.46F);
    const std::string key = describe(action.shortcut);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float end = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x - ui::scaled(12);
    ImGui::PushClipRect(at, {end - ImGui::CalcTextSize(key.c_str()).x, at.y + ImGui::GetTextLineHeight()},
                        true);
    ui::mutedText(why.empty() ? menu : menu + "   (" + why + ")");
    ImGui::PopClipRect();
    rightText(ui::palette::accent, key);
  }
  if (found.empty()) ui::mutedText(tr("No command has these letters."));
  ImGui::EndChild();
  ImGui::Separator();
  if (!found.empty()) {
    const Action& action = *found[std::size_t(selected_)];
    ui::wrappedText(ui::palette::muted, tr(action.help.empty() ? action.label : action.help));
    if (std::exchange(enter_, false)) run = &action;
  }
  if (run == nullptr || !run->enabled(context.actions)) return;
  context.state().dialog = Dialog::none;  // first: the action may ask for another
  ImGui::CloseCurrentPopup();
  runAction(context, *run);
}

void CommandList::drawKeys(PanelContext& context) {
  drawField(tr("Find a key, or what it does"), context.log);
  const auto found = searchKeys(context.table, query_);
  const float step = ImGui::GetTextLineHeightWithSpacing();
  ImGui::BeginChild("##found");
  if (const int moved = std::exchange(steps_, 0); moved != 0)
    ImGui::SetScrollY(ImGui::GetScrollY() + float(moved) * step);
  if (ImGui::BeginTable("##keys", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) {
    ImGui::TableSetupColumn(tr("Keys"), 0, 0.33F);
    ImGui::TableSetupColumn(tr("What they do"), 0, 0.51F);
    ImGui::TableSetupColumn(tr("Where"), 0, 0.16F);
    ImGui::TableHeadersRow();
    for (const KeyHelp& line : found) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ui::wrappedText(ui::palette::accent, line.keys);
      ImGui::TableNextColumn();
      ui::wrappedText(ui::palette::text, line.what);
      ImGui::TableNextColumn();
      ui::mutedText(line.where);
    }
    ImGui::EndTable();
  }
  if (found.empty()) ui::mutedText(tr("No key does that. Ctrl+Shift+P finds commands without a key, too."));
  ImGui::EndChild();
  escape_ = escape_ || std::exchange(enter_, false);
}

void CommandList::draw(PanelContext& context) {
  const Dialog dialog = context.state().dialog;
  const bool wanted = dialog == Dialog::commands || dialog == Dialog::shortcuts;
  if (wanted && !shown_) begin();
  shown_ = wanted;
  if (!wanted) return;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({display.x / 2, display.y * 0.12F}, ImGuiCond_Always, {0.5F, 0});
  ImGui::SetNextWindowSize({std::clamp(display.x - ui::scaled(40), 1.0F, ui::scaled(720)),
                            std::clamp(display.y * 0.7F, 1.0F, ui::scaled(520))});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ui::scaled(ImVec2(14, 12)));
  const bool open = ImGui::BeginPopup(kPopup, ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav);
  ImGui::PopStyleVar();
  if (open) {
    if (dialog == Dialog::commands)
      drawCommands(context);
    else
      drawKeys(context);
    if (escape_) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
  }
  if (!open || escape_) {  // closed by a click elsewhere, or by Esc
    if (context.state().dialog == dialog) context.state().dialog = Dialog::none;
    shown_ = false;
  }
  escape_ = enter_ = false;
}

}  // namespace acentric::editor
