#pragma once
/// What the plan's tools draw while they are in hand.

#include <imgui.h>

#include <span>

#include "editor/commands/outline_edits.h"
#include "editor/tools/plan_tool.h"
#include "ui/canvas_view.h"

namespace acentric::editor {

/// The box that selects, with how many cells it touches.
void drawMarquee(ImDrawList& list, const ui::CanvasView& view, const MarqueeIntent& box, std::size_t cells,
                 ImFont* font);
/// Middle, circle and corner that the lattice is laid by; `pointer`: where it is, in pixels.
void drawLatticeHandles(ImDrawList& list, const ui::CanvasView& view, const LatticeHandles& handles,
                        const LatticeTool& tool, const glm::dvec2& pointer, ImFont* font);
void drawRuler(ImDrawList& list, const ui::CanvasView& view, const MeasureTool::Ruler& ruler, ImFont* font);
/// A rectangle that is being drawn, with its sides' lengths.
void drawOutlineRectangle(ImDrawList& list, const ui::CanvasView& view, std::span<const glm::dvec2> corners,
                          ImFont* font);
/// Marks with what is wrong there; the first ones in words.
void drawOutlineFaults(ImDrawList& list, const ui::CanvasView& view, std::span<const OutlineFault> faults,
                       ImFont* font);
void drawLoopAreas(ImDrawList& list, const ui::CanvasView& view, std::span<const LoopArea> areas,
                   ImFont* font);

}  // namespace acentric::editor
