#include "editor/panels/report_panel.h"

#include "editor/session/engine_texts.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

void lines(const char* heading, const std::vector<std::string>& entries, const ui::Colour& colour) {
  for (const std::string& entry : entries) {
    ui::badge(colour, heading);
    ImGui::SameLine(ui::scaled(92));
    ui::wrappedText(ui::palette::text, engineText(entry));
  }
}

}  // namespace

void drawReportPanel(PanelContext& context) {
  ui::panelTitle(context.window.fonts().bold, tr("Scene"));
  const auto& built = context.session().built();
  if (!built) {
    ui::wrappedText(ui::palette::faint, tr("What is found in a model is told here."));
    return;
  }
  const Scene& scene = *built->scene;
  lines(tr("found"), scene.report.found, ui::palette::good);
  lines(tr("guessed"), scene.report.guessed, ui::palette::accent);
  lines(tr("dropped"), scene.report.dropped, ui::palette::warning);
  lines(tr("ignored"), scene.report.ignored, ui::palette::faint);
}

}  // namespace acentric::editor
