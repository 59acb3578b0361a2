#include "editor/panels/history_panel.h"

#include <fmt/format.h>

#include "ui/text_format.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

void drawSummary(PanelContext& context) {
  Session& session = context.session();
  const History& history = session.history();
  std::string text = trfMany("{} entry, {} of", "{} entries, {} of", history.size(),
                             ui::formatCount(history.size()), ui::formatBytes(history.bytes()));
  ImGui::AlignTextToFramePadding();
  ui::mutedText(text);
  if (history.dropped() > 0)
    ui::tooltip(trf("{} older entries had no room any more.", ui::formatCount(history.dropped())));
  ImGui::SameLine(0, 6);
  int& megabytes = session.preferences().historyMegabytes;
  ImGui::SetNextItemWidth(86);
  const bool changed =
      ImGui::DragInt("##historyMemory", &megabytes, 1, 1, 1'000'000, "%d MB", ImGuiSliderFlags_AlwaysClamp);
  context.log.item("history.memory");
  ui::tooltip(tr("What the history may take; beyond it the oldest entries go. Remembered for all projects."));
  if (changed) session.historyMemoryChanged();
  if (ImGui::IsItemDeactivatedAfterEdit()) session.savePreferencesNow();
}

void drawEntry(PanelContext& context, std::size_t entry) {
  Session& session = context.session();
  const History& history = session.history();
  const bool current = entry == history.cursor();
  const ui::Colour colour = current                    ? ui::palette::text
                            : entry > history.cursor() ? ui::palette::faint
                                                       : ui::palette::muted;
  ImGui::PushStyleColor(ImGuiCol_Text, colour.vec());
  const std::string label =
      fmt::format("{:>3}   {}##{}", history.dropped() + entry, history.label(entry), entry);
  const bool clicked = ImGui::Selectable(label.c_str(), current);
  ImGui::PopStyleColor();
  context.log.item(fmt::format("history.{}", entry));
  if (clicked) session.goTo(entry);
}

}  // namespace

void drawHistoryPanel(PanelContext& context) {
  if (!context.session().hasProject()) {
    ui::wrappedText(ui::palette::faint, tr("Every edit of a project is listed here."));
    return;
  }
  drawSummary(context);
  ImGui::BeginChild("##entries");
  const History& history = context.session().history();
  const float line = ImGui::GetTextLineHeightWithSpacing();
  ImGuiListClipper clipper;
  clipper.Begin(int(history.size()), line);
  while (clipper.Step())
    for (int entry = clipper.DisplayStart; entry < clipper.DisplayEnd; ++entry)
      if (std::size_t(entry) < history.size()) drawEntry(context, std::size_t(entry));
  // The current one stays in sight when it changes; else the list is left where it is.
  const ImGuiID shown = ImGui::GetID("##shown");
  ImGuiStorage& storage = *ImGui::GetStateStorage();
  const int at = int(history.dropped() + history.cursor());
  if (storage.GetInt(shown, -1) != at) {
    storage.SetInt(shown, at);
    ImGui::SetScrollFromPosY(ImGui::GetCursorStartPos().y + (float(history.cursor()) + 0.5F) * line);
  }
  ImGui::EndChild();
}

}  // namespace acentric::editor
