#include "editor/panels/problems_panel.h"

#include <fmt/format.h>

#include "editor/actions/problem_actions.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

constexpr float kButtonsWidth = 158, kLeastBeside = 460;  // narrower: buttons below the text

/// What a way out does that is no action.
const char* helpOf(const ProblemFix& fix) {
  if (std::holds_alternative<MoveFreeApv>(fix.way)) return tr("The smallest move that clears it");
  if (std::holds_alternative<AddPanorama>(fix.way))
    return tr("Six cameras where one can stand in the cell: they show what its own don't see");
  if (std::holds_alternative<RemoveCell>(fix.way)) return tr("Nobody can stand in it, so nothing is lost");
  return tr("Imports the model again at this scale; cells, outline and paths stay where they are on it");
}

void drawFix(PanelContext& context, const ProblemFix& fix, int row) {
  Session& session = context.session();
  const auto* run = std::get_if<RunAction>(&fix.way);
  const Action* action = run != nullptr ? findAction(context.table, run->id) : nullptr;
  const bool possible = action == nullptr ? session.built() != nullptr : action->enabled(context.actions);
  ImGui::BeginDisabled(!possible);
  const bool clicked = ImGui::SmallButton(fix.label.c_str());
  ImGui::EndDisabled();
  context.log.item(fmt::format("problem.{}.fix", row));
  if (run == nullptr)
    ui::tooltip(helpOf(fix));
  else if (action != nullptr && !action->help.empty())
    ui::tooltip(tr(action->help));
  if (!clicked || !possible) return;
  if (action != nullptr)
    runAction(context, *action);
  else if (auto edit = editOf(fix, session.project(), *session.built()->scene))
    session.apply(*std::move(edit));
}

void drawRow(PanelContext& context, const Problem& problem, int row, bool beside) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ui::badge(colourOf(problem.severity), "");
  ImGui::TableNextColumn();
  ui::wrappedText(ui::palette::text, problem.text);
  if (beside) ImGui::TableNextColumn();
  ImGui::PushID(row);
  if (problem.place.any()) {
    if (ImGui::SmallButton(tr("Show"))) showProblem(context.state(), problem.place);
    context.log.item(fmt::format("problem.{}.show", row));
    if (problem.fix) ImGui::SameLine(0, 6);
  }
  if (problem.fix) drawFix(context, *problem.fix, row);
  ImGui::PopID();
}

}  // namespace

ui::Colour colourOf(Severity severity) {
  switch (severity) {
    case Severity::note:
      return ui::palette::muted;
    case Severity::warning:
      return ui::palette::warning;
    case Severity::error:
      break;
  }
  return ui::palette::danger;
}

ProblemMark problemMark(const Session& session) {
  const int errors = countProblems(session.problems(), Severity::error);
  const int warnings = countProblems(session.problems(), Severity::warning);
  if (errors + warnings == 0) return {};
  return {fmt::format("{}", errors + warnings), colourOf(errors > 0 ? Severity::error : Severity::warning)};
}

void drawProblemsPanel(PanelContext& context) {
  // A fix changes the list while it is drawn.
  const std::vector<Problem> problems = context.session().problems();
  if (problems.empty()) {
    ui::wrappedText(ui::palette::faint, context.session().hasProject()
                                            ? tr("Nothing is wrong.")
                                            : tr("What is wrong with a project is listed here."));
    return;
  }
  constexpr ImGuiTableFlags kFlags =
      ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_PadOuterX;
  const bool beside = ImGui::GetContentRegionAvail().x >= ui::scaled(kLeastBeside);
  if (!ImGui::BeginTable("##problems", beside ? 3 : 2, kFlags)) return;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, ui::scaled(12));
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
  if (beside) ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, ui::scaled(kButtonsWidth));
  for (std::size_t row = 0; row < problems.size(); ++row) drawRow(context, problems[row], int(row), beside);
  ImGui::EndTable();
}

}  // namespace acentric::editor
