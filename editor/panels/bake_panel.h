#pragma once
/// The bake: what is there, what is missing, progress, time left, cancel.

#include "editor/panels/panel_context.h"

namespace acentric::editor {

void drawBakePanel(PanelContext& context);
/// "1 thread", "4 threads"
std::string threadsText(int threads);

/// "Baking: baking camera 12, 12 of 54" for any running job, and how far it is (< 0: unknown).
std::string progressText(const Job& job);
double progressFraction(const Job& job);

}  // namespace acentric::editor
