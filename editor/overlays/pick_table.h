#pragma once
/// What cameras say of a picked point, as a small table.

#include "editor/panels/panel_context.h"
#include "editor/session/scene_pick.h"

namespace acentric::editor {

/// In the upper right corner of an area of the current window (screen pixels); where it lies is returned: min
/// and max. `pick` null: the cameras are being asked.
std::pair<ImVec2, ImVec2> drawPickTable(PanelContext& context, const ImVec2& areaMin, const ImVec2& areaMax,
                                        const ScenePick* pick);

}  // namespace acentric::editor
