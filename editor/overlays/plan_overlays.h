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
#include "engine/pipeline/project.h"
#include "ui/canvas_view.h"
#include "ui/colour.h"

namespace acentric::editor {

/// The cell under the pointer: what a click would take, or add.
void drawHovered(ImDrawList& list, const ui::CanvasView& view, const ConvexPolygon& polygon, bool placed);
/// Cells that were placed or taken away since the layout was laid, until it is laid anew.
void drawPending(ImDrawList& list, const ui::CanvasView& view, const LayoutSpec& laid,
                 const LayoutSpec& wanted);
/// What the colours of cells by triangles mean, in the lower left corner.
void drawTriangleLegend(ImDrawList& list, const ui::CanvasView& view, const Inspection& inspection,
                        std::size_t budget, ImFont* font);
/// Of the colours of cells by density; `samplesPerDegree`: the project's.
void drawDensityLegend(ImDrawList& list, const ui::CanvasView& view, double samplesPerDegree, ImFont* font);
/// The same of signs where cameras stand badly, with how many of each there are.
void drawChecksLegend(ImDrawList& list, const ui::CanvasView& view, const PlacementReport& report,
                      ImFont* font);
/// The same of the bytes on disk.
void drawBytesLegend(ImDrawList& list, const ui::CanvasView& view, std::uint64_t most, std::uint64_t all,
                     ImFont* font);
/// Marks where findings lie, and with an arrow where a centre would stand free. Returns the one under the
/// pointer.
const PlacementFinding* drawFindings(ImDrawList& list, const ui::CanvasView& view,
                                     const PlacementReport& report, const glm::dvec2& pointer);
void drawOutline(ImDrawList& list, const ui::CanvasView& view, const Outline& outline);
/// Ground that can be walked, of which the layout has a part: fainter.
void drawWalkable(ImDrawList& list, const ui::CanvasView& view, const Outline& walkable);
/// Pieces of stairs and ramps that are not worked on: outlines, and arrows upwards.
void drawStairs(ImDrawList& list, const ui::CanvasView& view, const Project& project);
/// Corners that can be taken hold of; with a pointer, what a press there would do.
void drawOutlineHandles(ImDrawList& list, const ui::CanvasView& view, const Outline& outline,
                        const glm::dvec2* pointer);
/// Centres of panoramas beside the lattice and where their cameras stand, one that is being placed too.
void drawFreeApvs(ImDrawList& list, const ui::CanvasView& view, const LayoutSpec& spec,
                  const std::set<CellId>& selection, const std::optional<Apv>& inHand);
/// The corners of an outline that is being drawn, with a line to the pointer.
void drawOutlineInHand(ImDrawList& list, const ui::CanvasView& view, std::span<const glm::dvec2> corners,
                       const glm::dvec2& pointer);
/// `size` 1: as on the plan.
void drawEye(ImDrawList& list, const ui::CanvasView& view, const WalkPose& pose, double fovRadians,
             const Region* region, float size = 1);
void drawStart(ImDrawList& list, const ui::CanvasView& view, const glm::dvec2& position, double yawRadians);

}  // namespace acentric::editor
