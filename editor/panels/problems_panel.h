#pragma once
/// The list of what is wrong or deserves a look, each with a way there and, where there is one, a way out.

#include "editor/panels/panel_context.h"

namespace acentric::editor {

ui::Colour colourOf(Severity severity);

/// How many errors and warnings there are, for a tab or the status bar: "3", in the colour of the worst.
/// Empty without any.
struct ProblemMark {
  std::string text;
  ui::Colour colour = ui::palette::muted;
};
ProblemMark problemMark(const Session& session);

void drawProblemsPanel(PanelContext& context);

}  // namespace acentric::editor
