#pragma once
/// The bake: what is there, what is missing, progress, time left, cancel.

#include "editor/panels/panel_context.h"

namespace acentric::editor {

void drawBakePanel(PanelContext& context);
/// "1 thread", "4 threads"
std::string threadsText(int threads);

/// "Baking: baking camera 12, 12 of 54" for any running job, and how far it is (< 0: unknown).
std::string progressText(const Job& job);
/// The same of the bake that runs: its stages count the cameras of one part of it, this counts all.
std::string bakeProgressText(const Session& session);
double progressFraction(const Job& job);

}  // namespace acentric::editor
