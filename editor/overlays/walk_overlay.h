#pragma once
/// Paths and bookmarks on the plan.

#include <imgui.h>

#include "editor/tools/path_tool.h"
#include "engine/pipeline/pipeline.h"
#include "ui/canvas_view.h"
#include "ui/colour.h"

namespace acentric::editor {

inline constexpr ui::Colour kPathColour = ui::Colour::hex(0xc29bff);

/// Lines of the storey's paths with the way they go; of the selected one its key poses with a tick where each
/// looks, red where one cannot walk. With a pointer (the path tool is at work), what a press there would
/// take.
void drawPaths(ImDrawList& list, const ui::CanvasView& view, const PathSituation& situation,
               const OpenProject& open, const glm::dvec2* pointer);
void drawBookmarks(ImDrawList& list, const ui::CanvasView& view, const Project& project,
                   const Bookmark* selected, ImFont* font);

}  // namespace acentric::editor
