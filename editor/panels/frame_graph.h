#pragma once
/// The graph of frame times: a stacked bar for each of the newest frames of the walk, newest at the right.

#include "editor/panels/panel_context.h"
#include "editor/session/frame_times.h"

namespace acentric::editor {

/// Between two corners on the window; the pointer on a bar tells its parts.
void drawFrameGraph(PanelContext& context, ImDrawList& list, const ImVec2& low, const ImVec2& high,
                    const FrameTimes& times);

}  // namespace acentric::editor
