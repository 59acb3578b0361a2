#pragma once
/// What a pixel of the walk that was asked about is, and the changes that would improve it, each to be had by
/// a click.

#include <utility>

#include "editor/panels/panel_context.h"

namespace acentric::editor {

/// In that upper corner of an area of the current window (screen pixels) which is away from the pixel; where
/// it lies is returned: min and max. `contentHeight`: kept from frame to frame. Nothing is drawn, and both
/// are (0, 0), where nothing was asked.
std::pair<ImVec2, ImVec2> drawAnswerCard(PanelContext& context, const ImVec2& areaMin, const ImVec2& areaMax,
                                         float& contentHeight);

}  // namespace acentric::editor
