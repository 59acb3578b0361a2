#include "editor/overlays/plan_overlays.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "editor/overlays/bake_signs.h"
#include "ui/canvas_draw.h"
#include "ui/theme.h"

namespace acentric::editor {
namespace {

using ui::imVec;
namespace palette = ui::palette;
using ui::scaled;

}  // namespace

void drawHovered(ImDrawList& list, const ui::CanvasView& view, const ConvexPolygon& polygon, bool placed) {
  if (placed)
    return ui::drawConvex(list, view, polygon.corners, palette::text.withOpacity(0.13F),
                          palette::text.withOpacity(0.4F), 1.2F);
  ui::drawConvex(list, view, polygon.corners, palette::accent.withOpacity(0.16F),
                 palette::accent.withOpacity(0.9F), 1);
  const ImVec2 at = imVec(view.screenFromWorld(polygon.centroid()));
  const float arm = scaled(6);
  list.AddLine({at.x - arm, at.y}, {at.x + arm, at.y}, palette::accent.packed(), scaled(2));
  list.AddLine({at.x, at.y - arm}, {at.x, at.y + arm}, palette::accent.packed(), scaled(2));
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

void drawWalkable(ImDrawList& list, const ui::CanvasView& view, const Outline& walkable) {
  for (const auto& loop : walkable.loops)
    ui::drawDashed(list, view, loop, true, palette::text.withOpacity(0.2F), 1);
}

void drawStairs(ImDrawList& list, const ui::CanvasView& view, const Project& project) {
  constexpr double kLeastRise = 0.01;  // metres per metre: a landing has no arrow
  const auto colour = palette::accent.withOpacity(0.55F).packed();
  for (std::size_t s = 0; s < project.storeys.size(); ++s) {
    const LayoutSpec& spec = project.storeys[s].layout;
    if (!spec.slope || int(s) == project.storey) continue;
    for (const auto& loop : spec.outline.loops)
      ui::drawDashed(list, view, loop, true, palette::accent.withOpacity(0.35F), 1);
    const double rise = glm::length(spec.slope->rise);
    const glm::dvec2 at = view.screenFromWorld(spec.slope->at);
    if (rise < kLeastRise || !view.contains(at)) continue;
    const glm::dvec2 ahead(spec.slope->rise.x / rise,
                           -spec.slope->rise.y / rise);  // the screen's y goes down
    const glm::dvec2 aside(-ahead.y, ahead.x);
    const double length = double(scaled(6));
    for (const double side : {1.0, -1.0})
      list.AddLine(imVec(at + length * ahead), imVec(at + length * side * aside), colour, scaled(1.6F));
  }
}

void drawOutlineHandles(ImDrawList& list, const ui::CanvasView& view, const Outline& outline,
                        const glm::dvec2* pointer) {
  for (const auto& loop : outline.loops) {
    ui::drawDashed(list, view, loop, true, palette::accent.withOpacity(0.9F), 1.6F);
    for (const glm::dvec2& corner : loop) {
      const glm::dvec2 screen = view.screenFromWorld(corner);
      if (!view.contains(screen)) continue;
      const ImVec2 at = imVec(screen);
      const float half = scaled(3.5F);
      list.AddRectFilled({at.x - half, at.y - half}, {at.x + half, at.y + half}, palette::backdrop.packed());
      list.AddRect({at.x - half, at.y - half}, {at.x + half, at.y + half}, palette::accent.packed(), 0, 0,
                   scaled(1.4F));
    }
  }
  if (pointer == nullptr) return;
  const OutlineHit hit = hitOutline(outline, *pointer, view.pixelsPerMetre() / double(ui::interfaceScale()));
  if (hit.kind == OutlineHit::Kind::nothing) return;
  const ImVec2 at = imVec(view.screenFromWorld(hit.place));
  if (hit.kind == OutlineHit::Kind::corner) {
    const float half = scaled(5);
    list.AddRectFilled({at.x - half, at.y - half}, {at.x + half, at.y + half}, palette::accent.packed());
    return;
  }
  const float arm = scaled(3);
  list.AddCircleFilled(at, scaled(5.5F), palette::backdrop.packed());
  list.AddCircle(at, scaled(5.5F), palette::accent.packed(), 0, scaled(1.6F));
  list.AddLine({at.x - arm, at.y}, {at.x + arm, at.y}, palette::accent.packed(), scaled(1.4F));
  list.AddLine({at.x, at.y - arm}, {at.x, at.y + arm}, palette::accent.packed(), scaled(1.4F));
}

namespace {

void drawFreeApv(ImDrawList& list, const ui::CanvasView& view, const Apv& apv, const ui::Colour& colour) {
  const glm::dvec2 centre = view.screenFromWorld(apv.centre);
  const ImVec2 at = imVec(centre);
  list.AddCircleFilled(at, scaled(5), palette::backdrop.withOpacity(0.85F).packed());
  list.AddCircle(at, scaled(5), colour.packed(), 0, scaled(1.6F));
  list.AddCircleFilled(at, scaled(1.8F), colour.packed());
  if (apv.traditional()) return;
  ui::drawDashed(list, view, polygonOf(apv).corners, true, colour.withOpacity(0.8F), 1.4F);
  // The first camera, from which the others follow.
  const ImVec2 first = imVec(view.screenFromWorld(apv.centre + apv.offset));
  list.AddLine(at, first, colour.withOpacity(0.7F).packed(), 1.2F);
  list.AddCircleFilled(first, scaled(2.6F), colour.packed());
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
    list.AddCircleFilled(at, scaled(i == 0 ? 6 : 4), palette::accent.packed());
  }
}

void drawEye(ImDrawList& list, const ui::CanvasView& view, const WalkPose& pose, double fovRadians,
             const Region* region, float size) {
  if (region != nullptr)
    ui::drawDashed(list, view, region->grown.corners, true, palette::accent.withOpacity(0.5F), 1);
  const ImVec2 at = imVec(view.screenFromWorld(glm::dvec2(pose.eye)));
  const float cone = scaled(74) * size;
  const double low = -pose.yawRadians - fovRadians / 2;
  list.PathLineTo(at);
  list.PathArcTo(at, cone, float(low), float(low + fovRadians), 16);
  list.PathFillConvex(palette::accent.withOpacity(0.20F).packed());
  for (const double side : {low, low + fovRadians}) {
    const ImVec2 end(at.x + cone * float(std::cos(side)), at.y + cone * float(std::sin(side)));
    list.AddLine(at, end, palette::accent.withOpacity(0.85F).packed(), 1.4F);
  }
  list.AddCircleFilled(at, scaled(8) * size, palette::backdrop.packed());
  list.AddCircleFilled(at, scaled(6.5F) * size, palette::accent.packed());
  list.AddCircleFilled(at, scaled(2.2F) * size, palette::onAccent.packed());
}

void drawStart(ImDrawList& list, const ui::CanvasView& view, const glm::dvec2& position, double yawRadians) {
  const glm::dvec2 at = view.screenFromWorld(position);
  if (!view.contains(at)) return;
  const auto towards = [&](double angle, double length) {
    return imVec(at + double(ui::interfaceScale()) * length * glm::dvec2(std::cos(angle), -std::sin(angle)));
  };
  constexpr double kBack = 2.5;
  const ImU32 colour = palette::text.withOpacity(0.9F).packed();
  list.AddTriangleFilled(towards(yawRadians, 8), towards(yawRadians + kBack, 7),
                         towards(yawRadians - kBack, 7), colour);
  list.AddCircle(imVec(at), scaled(10.5F), colour, 0, scaled(1.2F));
}

}  // namespace acentric::editor
