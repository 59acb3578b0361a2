#include "editor/panels/status_bar.h"

#include <fmt/format.h>

#include "editor/panels/bake_panel.h"
#include "ui/text_format.h"

namespace acentric::editor {
namespace {

const char* hintOf(PlanMode mode) {
  switch (mode) {
    case PlanMode::cells:
      return "Click adds or selects a cell, drag moves it, Del removes it   ·   right drag pans, wheel zooms "
             "  ·   WASD walks";
    case PlanMode::eye:
      return "Press to put the eye there, drag to turn it   ·   WASD walks";
    case PlanMode::outline:
      return "Click free ground to draw a loop (Enter closes it); drag corners and sides, Ctrl+click takes a "
             "corner away; Esc gives up";
    case PlanMode::panorama:
      return "Click or drag free ground to place a panorama; click one to select it, drag moves it, "
             "Ctrl+click "
             "removes it";
  }
  return "";
}

std::string workText(const Session& session) {
  const Job* jobs[] = {&session.opening(),   &session.rebuilding(),      &session.baking(),
                       &session.loading(),   &session.drawingBackdrop(), &session.searching(),
                       &session.estimating()};
  for (const Job* job : jobs)
    if (job->running()) return progressText(*job);
  return {};
}

}  // namespace

void drawStatusBar(PanelContext& context) {
  Session& session = context.session();
  ImGui::SetCursorPos({12, (kStatusBarPixels - ImGui::GetTextLineHeight()) / 2});
  const std::string work = workText(session);
  if (!work.empty())
    ui::badge(ui::palette::accent, work);
  else if (session.hasProject())
    ui::badge(session.dirty() ? ui::palette::warning : ui::palette::good, session.untitled() ? "not saved yet"
                                                                          : session.dirty()
                                                                              ? "unsaved changes"
                                                                              : "saved");
  else
    ui::badge(ui::palette::faint, "ready");
  if (!session.hasProject()) return;
  const char* hint = hintOf(context.state().planTool.mode());
  const std::string file = ui::shortenPath(session.file().string(), 52);
  ImGui::SameLine(324);
  ui::mutedText(hint);
  ImGui::SameLine(ImGui::GetWindowSize().x - ImGui::CalcTextSize(file.c_str()).x - 12);
  ui::mutedText(file);
  ui::tooltip(session.file().string());
}

}  // namespace acentric::editor
