#include "editor/overlays/plan_overlays.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "editor/commands/layout_edits.h"
#include "ui/canvas_draw.h"

namespace acentric::editor {
namespace {

using ui::imVec;
namespace palette = ui::palette;

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

void drawHovered(ImDrawList& list, const ui::CanvasView& view, const ConvexPolygon& polygon, bool placed) {
  if (placed)
    return ui::drawConvex(list, view, polygon.corners, palette::text.withOpacity(0.13F),
                          palette::text.withOpacity(0.4F), 1.2F);
  ui::drawConvex(list, view, polygon.corners, palette::accent.withOpacity(0.16F),
                 palette::accent.withOpacity(0.9F), 1);
  const ImVec2 at = imVec(view.screenFromWorld(polygon.centroid()));
  list.AddLine({at.x - 6, at.y}, {at.x + 6, at.y}, palette::accent.packed(), 2);
  list.AddLine({at.x, at.y - 6}, {at.x, at.y + 6}, palette::accent.packed(), 2);
}

void drawPending(ImDrawList& list, const ui::CanvasView& view, const LayoutSpec& laid,
                 const LayoutSpec& wanted) {
  LayoutSpec same = laid;
  same.added = wanted.added;
  same.removed = wanted.removed;
  if (same != wanted) return;  // another lattice: nothing stays where it is
  constexpr std::size_t kMost = 500;
  std::vector<CellId> changed;
  std::ranges::set_symmetric_difference(laid.added, wanted.added, std::back_inserter(changed));
  std::ranges::set_symmetric_difference(laid.removed, wanted.removed, std::back_inserter(changed));
  if (changed.size() > kMost) changed.resize(kMost);
  const ui::Colour missing = colourOf(BakeState::missing);
  for (const CellId& cell : changed) {
    const ConvexPolygon polygon = cellPolygon(wanted, cell);
    if (isPlaced(wanted, cell))
      ui::drawConvex(list, view, polygon.corners, missing.withOpacity(0.2F), missing.withOpacity(0.75F),
                     1.2F);
    else
      ui::drawConvex(list, view, polygon.corners, palette::backdrop.withOpacity(0.8F),
                     palette::backdrop.withOpacity(0.8F), 2);
  }
}

void drawOutline(ImDrawList& list, const ui::CanvasView& view, const Outline& outline) {
  for (const auto& loop : outline.loops)
    ui::drawDashed(list, view, loop, true, palette::text.withOpacity(0.42F), 1.2F);
}

void drawOutlineHandles(ImDrawList& list, const ui::CanvasView& view, const Outline& outline,
                        const glm::dvec2* pointer) {
  for (const auto& loop : outline.loops) {
    ui::drawDashed(list, view, loop, true, palette::accent.withOpacity(0.9F), 1.6F);
    for (const glm::dvec2& corner : loop) {
      const glm::dvec2 screen = view.screenFromWorld(corner);
      if (!view.contains(screen)) continue;
      const ImVec2 at = imVec(screen);
      list.AddRectFilled({at.x - 3.5F, at.y - 3.5F}, {at.x + 3.5F, at.y + 3.5F}, palette::backdrop.packed());
      list.AddRect({at.x - 3.5F, at.y - 3.5F}, {at.x + 3.5F, at.y + 3.5F}, palette::accent.packed(), 0, 0,
                   1.4F);
    }
  }
  if (pointer == nullptr) return;
  const OutlineHit hit = hitOutline(outline, *pointer, view.pixelsPerMetre());
  if (hit.kind == OutlineHit::Kind::nothing) return;
  const ImVec2 at = imVec(view.screenFromWorld(hit.place));
  if (hit.kind == OutlineHit::Kind::corner) {
    list.AddRectFilled({at.x - 5, at.y - 5}, {at.x + 5, at.y + 5}, palette::accent.packed());
    return;
  }
  list.AddCircleFilled(at, 5.5F, palette::backdrop.packed());
  list.AddCircle(at, 5.5F, palette::accent.packed(), 0, 1.6F);
  list.AddLine({at.x - 3, at.y}, {at.x + 3, at.y}, palette::accent.packed(), 1.4F);
  list.AddLine({at.x, at.y - 3}, {at.x, at.y + 3}, palette::accent.packed(), 1.4F);
}

namespace {

void drawFreeApv(ImDrawList& list, const ui::CanvasView& view, const Apv& apv, const ui::Colour& colour) {
  const glm::dvec2 centre = view.screenFromWorld(apv.centre);
  const ImVec2 at = imVec(centre);
  list.AddCircleFilled(at, 5, palette::backdrop.withOpacity(0.85F).packed());
  list.AddCircle(at, 5, colour.packed(), 0, 1.6F);
  list.AddCircleFilled(at, 1.8F, colour.packed());
  if (apv.traditional()) return;
  ui::drawDashed(list, view, polygonOf(apv).corners, true, colour.withOpacity(0.8F), 1.4F);
  // The first camera, from which the others follow.
  const ImVec2 first = imVec(view.screenFromWorld(apv.centre + apv.offset));
  list.AddLine(at, first, colour.withOpacity(0.7F).packed(), 1.2F);
  list.AddCircleFilled(first, 2.6F, colour.packed());
}

}  // namespace

void drawFreeApvs(ImDrawList& list, const ui::CanvasView& view, const LayoutSpec& spec,
                  const std::set<CellId>& selection, const std::optional<Apv>& inHand) {
  for (const auto& [number, apv] : spec.freeApvs) {
    const bool selected = selection.contains({number, 0, kFreeSlot});
    drawFreeApv(list, view, apv, selected ? palette::accent : palette::text);
  }
  if (inHand) drawFreeApv(list, view, *inHand, palette::accent);
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
