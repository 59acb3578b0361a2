#pragma once
/// What is drawn on the plan over the backdrop. Each overlay is one function of the view and the data it
/// shows.

#include <imgui.h>

#include <set>
#include <span>

#include "editor/session/capture_status.h"
#include "editor/session/inspection.h"
#include "editor/tools/plan_tool.h"
#include "editor/tools/walker.h"
#include "engine/layout/layout.h"
#include "ui/canvas_view.h"
#include "ui/colour.h"

namespace acentric::editor {

ui::Colour colourOf(BakeState state);

/// Is a polygon on the screen at all?
bool onScreen(const ui::CanvasView& view, const ConvexPolygon& polygon);

void drawRegions(ImDrawList& list, const ui::CanvasView& view, const Layout& layout,
                 const CaptureStatus& status, const std::set<CellId>& selection, const CellId* hovered);
/// Cells by their triangles of local geometry: from none to the most that any has, those over the budget in
/// the colour of danger.
void drawTriangles(ImDrawList& list, const ui::CanvasView& view, const Inspection& inspection,
                   std::size_t budget);
/// What the colours mean, in the lower left corner.
void drawTriangleLegend(ImDrawList& list, const ui::CanvasView& view, const Inspection& inspection,
                        std::size_t budget, ImFont* font);
/// Marks where findings lie, and with an arrow where a centre would stand free. Returns the one under the
/// pointer.
const PlacementFinding* drawFindings(ImDrawList& list, const ui::CanvasView& view,
                                     const PlacementReport& report, const glm::dvec2& pointer);
/// Cells that are not placed.
void drawFreeCells(ImDrawList& list, const ui::CanvasView& view, std::span<const LatticeCell> cells,
                   const CellId* hovered);
/// Dots at the centres of projection; sectors too where there is room.
void drawCameras(ImDrawList& list, const ui::CanvasView& view, const Layout& layout,
                 const CaptureStatus& status);
void drawOutline(ImDrawList& list, const ui::CanvasView& view, const Outline& outline);
/// The corners of an outline that is being drawn, with a line to the pointer.
void drawOutlineInHand(ImDrawList& list, const ui::CanvasView& view, std::span<const glm::dvec2> corners,
                       const glm::dvec2& pointer);
/// A cell on its way: where it comes from and where it would land; `possible` if that place is free.
void drawCellDrag(ImDrawList& list, const ui::CanvasView& view, const LayoutSpec& spec,
                  const PlanTool::CellDrag& drag, bool possible);
void drawEye(ImDrawList& list, const ui::CanvasView& view, const WalkPose& pose, double fovRadians,
             const Region* region);
void drawStart(ImDrawList& list, const ui::CanvasView& view, const glm::dvec2& position, double yawRadians);

}  // namespace acentric::editor
