#include "editor/overlays/plan_overlays.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/geometry/conventions.h"
#include "ui/canvas_draw.h"

namespace acentric::editor {
namespace {

using ui::imVec;
namespace palette = ui::palette;

constexpr double kSectorRoom = 64;  ///< pixels per cell edge from which sectors are shown

void drawSector(ImDrawList& list, const ImVec2& centre, double low, double fov, float radius,
                const ui::Colour& colour) {
  // Screen y points down, so angles turn the other way.
  list.PathLineTo(centre);
  list.PathArcTo(centre, radius, float(-low - fov), float(-low), 8);
  list.PathFillConvex(colour.withOpacity(0.22F).packed());
  list.PathLineTo(centre);
  list.PathArcTo(centre, radius, float(-low - fov), float(-low), 8);
  list.PathStroke(colour.withOpacity(0.8F).packed(), ImDrawFlags_Closed, 1);
}

}  // namespace

ui::Colour colourOf(BakeState state) {
  switch (state) {
    case BakeState::missing:
      return ui::Colour::hex(0x9aa6b8);
    case BakeState::partial:
      return palette::warning;
    case BakeState::baked:
      return palette::good;
  }
  return palette::muted;
}

bool onScreen(const ui::CanvasView& view, const ConvexPolygon& polygon) {
  glm::dvec2 low(std::numeric_limits<double>::max());
  glm::dvec2 high(std::numeric_limits<double>::lowest());
  for (const glm::dvec2& corner : polygon.corners) {
    const glm::dvec2 screen = view.screenFromWorld(corner);
    low = glm::min(low, screen);
    high = glm::max(high, screen);
  }
  const glm::dvec2 min = view.areaMin();
  const glm::dvec2 max = min + view.areaSize();
  return high.x >= min.x && high.y >= min.y && low.x <= max.x && low.y <= max.y;
}

void drawRegions(ImDrawList& list, const ui::CanvasView& view, const Layout& layout,
                 const CaptureStatus& status, const std::set<CellId>& selection, const CellId* hovered) {
  for (std::size_t i = 0; i < layout.regions.size(); ++i) {
    const Region& region = layout.regions[i];
    if (!onScreen(view, region.polygon)) continue;
    const BakeState state = i < status.regions.size() ? status.regions[i] : BakeState::missing;
    const ui::Colour colour = colourOf(state);
    const bool under = hovered != nullptr && *hovered == region.id;
    const float fill = region.kind == RegionKind::ring ? 0.20F : 0.11F;
    ui::drawConvex(list, view, region.polygon.corners, colour.withOpacity(under ? fill + 0.12F : fill),
                   colour.withOpacity(0.75F), 1.2F);
  }
  // Over their neighbours, whose borders they share.
  for (const CellId& cell : selection)
    if (const auto index = layout.findRegion(cell))
      ui::drawConvex(list, view, layout.regions[std::size_t(*index)].polygon.corners,
                     palette::accent.withOpacity(0.25F), palette::accent, 2.2F);
}

void drawFreeCells(ImDrawList& list, const ui::CanvasView& view, std::span<const LatticeCell> cells,
                   const CellId* hovered) {
  for (const LatticeCell& cell : cells) {
    const bool under = hovered != nullptr && *hovered == cell.id;
    ui::drawConvex(list, view, cell.polygon.corners,
                   under ? palette::accent.withOpacity(0.16F) : palette::text.withOpacity(0),
                   under ? palette::accent.withOpacity(0.9F) : palette::text.withOpacity(0.13F), 1);
    if (!under) continue;
    const ImVec2 at = imVec(view.screenFromWorld(cell.polygon.centroid()));
    list.AddLine({at.x - 6, at.y}, {at.x + 6, at.y}, palette::accent.packed(), 2);
    list.AddLine({at.x, at.y - 6}, {at.x, at.y + 6}, palette::accent.packed(), 2);
  }
}

void drawCameras(ImDrawList& list, const ui::CanvasView& view, const Layout& layout,
                 const CaptureStatus& status) {
  const double cell = layout.spec.cellSize * view.pixelsPerMetre();
  const float dot = float(std::clamp(cell * 0.05, 1.2, 3.5));
  const bool sectors = cell >= kSectorRoom;
  const float radius = float(std::min(26.0, cell * 0.18));
  for (std::size_t i = 0; i < layout.cameras.size(); ++i) {
    const LayoutCamera& camera = layout.cameras[i];
    const glm::dvec2 screen = view.screenFromWorld(camera.position);
    if (!view.contains(screen)) continue;
    const bool baked = i < status.cameras.size() && status.cameras[i];
    const ui::Colour colour = colourOf(baked ? BakeState::baked : BakeState::missing);
    if (sectors) drawSector(list, imVec(screen), camera.lowAzimuth, camera.fovRadians, radius, colour);
    list.AddCircleFilled(imVec(screen), dot + 1, palette::backdrop.withOpacity(0.8F).packed());
    list.AddCircleFilled(imVec(screen), dot, colour.packed());
  }
}

void drawOutline(ImDrawList& list, const ui::CanvasView& view, const Outline& outline) {
  for (const auto& loop : outline.loops)
    ui::drawDashed(list, view, loop, true, palette::text.withOpacity(0.42F), 1.2F);
}

void drawOutlineInHand(ImDrawList& list, const ui::CanvasView& view, std::span<const glm::dvec2> corners,
                       const glm::dvec2& pointer) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const ImVec2 at = imVec(view.screenFromWorld(corners[i]));
    const ImVec2 next = imVec(view.screenFromWorld(i + 1 < corners.size() ? corners[i + 1] : pointer));
    list.AddLine(at, next, palette::accent.packed(), 2);
    list.AddCircleFilled(at, i == 0 ? 6.0F : 4.0F, palette::accent.packed());
  }
}

void drawCellDrag(ImDrawList& list, const ui::CanvasView& view, const LayoutSpec& spec,
                  const PlanTool::CellDrag& drag, bool possible) {
  const ConvexPolygon from = cellPolygon(spec, drag.from);
  const ConvexPolygon to = cellPolygon(spec, drag.to);
  ui::drawDashed(list, view, from.corners, true, palette::accent, 2);
  if (drag.from == drag.to) return;
  const ui::Colour colour = possible ? palette::accent : palette::danger;
  ui::drawConvex(list, view, to.corners, colour.withOpacity(0.30F), colour, 2.2F);
  list.AddLine(imVec(view.screenFromWorld(from.centroid())), imVec(view.screenFromWorld(to.centroid())),
               colour.withOpacity(0.8F).packed(), 1.5F);
}

void drawEye(ImDrawList& list, const ui::CanvasView& view, const WalkPose& pose, double fovRadians,
             const Region* region) {
  if (region != nullptr)
    ui::drawDashed(list, view, region->grown.corners, true, palette::accent.withOpacity(0.5F), 1);
  const ImVec2 at = imVec(view.screenFromWorld(glm::dvec2(pose.eye)));
  constexpr float kConePixels = 74;
  const double low = -pose.yawRadians - fovRadians / 2;
  list.PathLineTo(at);
  list.PathArcTo(at, kConePixels, float(low), float(low + fovRadians), 16);
  list.PathFillConvex(palette::accent.withOpacity(0.20F).packed());
  for (const double side : {low, low + fovRadians}) {
    const ImVec2 end(at.x + kConePixels * float(std::cos(side)), at.y + kConePixels * float(std::sin(side)));
    list.AddLine(at, end, palette::accent.withOpacity(0.85F).packed(), 1.4F);
  }
  list.AddCircleFilled(at, 8, palette::backdrop.packed());
  list.AddCircleFilled(at, 6.5F, palette::accent.packed());
  list.AddCircleFilled(at, 2.2F, palette::text.packed());
}

void drawStart(ImDrawList& list, const ui::CanvasView& view, const glm::dvec2& position, double yawRadians) {
  const glm::dvec2 at = view.screenFromWorld(position);
  if (!view.contains(at)) return;
  const auto towards = [&](double angle, double length) {
    return imVec(at + length * glm::dvec2(std::cos(angle), -std::sin(angle)));
  };
  constexpr double kBack = 2.5;
  const ImU32 colour = palette::text.withOpacity(0.9F).packed();
  list.AddTriangleFilled(towards(yawRadians, 8), towards(yawRadians + kBack, 7),
                         towards(yawRadians - kBack, 7), colour);
  list.AddCircle(imVec(at), 10.5F, colour, 0, 1.2F);
}

}  // namespace acentric::editor
