#pragma once
/// Signs for how far a region is baked: told apart by their shape, not by colour alone.

#include <imgui.h>

#include <span>

#include "editor/session/capture_status.h"
#include "ui/canvas_view.h"
#include "ui/colour.h"

namespace acentric::editor {

ui::Colour colourOf(BakeState state);

/// missing: an empty ring; partly: half full; stale: a clock; done: a check mark; baking: an arrow around;
/// failed: a cross. `radius` in pixels.
void drawBakeSign(ImDrawList& list, const ImVec2& at, BakeState state, float radius);

/// What the signs and colours mean, with how many regions there are of each; lower left corner.
void drawBakeLegend(ImDrawList& list, const ui::CanvasView& view, std::span<const BakeState> regions,
                    ImFont* font);

}  // namespace acentric::editor
