#include "editor/panels/messages_panel.h"

#include "ui/translate.h"

namespace acentric::editor {

ui::Colour colourOf(MessageLevel level) {
  switch (level) {
    case MessageLevel::info:
      return ui::palette::muted;
    case MessageLevel::good:
      return ui::palette::good;
    case MessageLevel::warning:
      return ui::palette::warning;
    case MessageLevel::error:
      return ui::palette::danger;
  }
  return ui::palette::muted;
}

void drawMessagesPanel(PanelContext& context) {
  if (context.session().messages().all().empty())
    return ui::wrappedText(ui::palette::faint, tr("What happens is told here."));
  ImGui::BeginChild("##lines");
  const bool atEnd = ImGui::GetScrollY() >= ImGui::GetScrollMaxY() - 1;
  for (const Message& message : context.session().messages().all()) {
    ImGui::PushStyleColor(ImGuiCol_Text, ui::palette::faint.vec());
    ImGui::TextUnformatted(message.time.c_str());
    ImGui::PopStyleColor();
    ImGui::SameLine();
    const ui::Colour colour =
        message.level == MessageLevel::info ? ui::palette::text : colourOf(message.level);
    ui::wrappedText(colour, message.text);
    if (ImGui::IsItemClicked()) ImGui::SetClipboardText(message.text.c_str());
    ui::tooltip(tr("Click to copy"));
  }
  const bool lit = context.now < context.state().messagesLitUntil;
  if (atEnd || lit) ImGui::SetScrollHereY(1);
  ImGui::EndChild();
  if (!lit) return;
  ImGui::GetWindowDrawList()->AddRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(),
                                      ui::palette::accent.packed(), ui::scaled(4), 0, ui::scaled(2));
  context.window.pacer().requestAt(context.state().messagesLitUntil);
}

}  // namespace acentric::editor
