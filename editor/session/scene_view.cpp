#include "editor/session/scene_view.h"

#include <algorithm>
#include <limits>

#include "engine/bake/flush_denormals.h"

namespace acentric::editor {
namespace {

constexpr double kSmallPiece = 0.01;  // of the largest piece's area
constexpr double kBeside = 1;         // cells: so far beyond the outline those at its border are framed too

WalkableBox nothing() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {glm::dvec2(kInfinity), glm::dvec2(-kInfinity)};
}
bool empty(const WalkableBox& box) { return !(box.low.x <= box.high.x && box.low.y <= box.high.y); }

void add(WalkableBox& box, const glm::dvec2& point) {
  box = {glm::min(box.low, point), glm::max(box.high, point)};
}

template <class Counts>
WalkableBox boxOf(const std::vector<Region>& regions, Counts counts) {
  WalkableBox box = nothing();
  for (const Region& region : regions)
    if (counts(region))
      for (const glm::dvec2& corner : region.polygon.corners) add(box, corner);
  return box;
}

/// Without what is a speck beside the rest.
Outline largePieces(const Outline& outline) {
  const auto areaOf = [](const std::vector<glm::dvec2>& loop) { return Outline{{loop}}.area(); };
  double largest = 0;
  for (const auto& loop : outline.loops) largest = std::max(largest, areaOf(loop));
  Outline large;
  for (const auto& loop : outline.loops)
    if (areaOf(loop) >= kSmallPiece * largest) large.loops.push_back(loop);
  return large;
}

}  // namespace

double ceilingCut(const Layout& layout, double eyeRange) {
  constexpr double kRoom = 0.12;  // of the eye height
  return layout.eyeZ() + eyeRange + kRoom * layout.spec.eyeHeight;
}

bool underCeiling(const RayScene& rays, const Layout& layout) {
  constexpr std::size_t kAsked = 64;
  const FlushDenormals flush;
  const std::size_t count = std::min(kAsked, layout.regions.size());
  std::size_t covered = 0;
  for (std::size_t n = 0; n < count; ++n) {
    const Region& region = layout.regions[n * layout.regions.size() / count];
    const glm::vec3 eye(glm::dvec3(region.polygon.centroid(), layout.eyeZ()));
    covered += rays.trace({eye, {0, 0, 1}}).found() ? 1 : 0;
  }
  return 2 * covered > count;
}

std::optional<WalkableBox> walkableBox(const Layout& layout) {
  const LayoutSpec& spec = layout.spec;
  const Outline walked = largePieces(spec.outline);
  WalkableBox outline = nothing();
  for (const auto& loop : walked.loops)
    for (const glm::dvec2& corner : loop) add(outline, corner);
  const double beside = kBeside * spec.cellSize;
  const WalkableBox cells =
      boxOf(layout.regions, [&](const Region& region) { return walked.overlaps(region.polygon); });
  const WalkableBox byHand = boxOf(layout.regions, [&](const Region& region) {
    return region.id.slot == kFreeSlot || spec.added.contains(region.id);
  });
  WalkableBox box = {glm::max(outline.low - beside, cells.low), glm::min(outline.high + beside, cells.high)};
  if (empty(box)) box = nothing();
  box = {glm::min(box.low, byHand.low), glm::max(box.high, byHand.high)};
  if (empty(box)) box = boxOf(layout.regions, [](const Region&) { return true; });
  return empty(box) ? std::nullopt : std::optional(box);
}

SceneBox boxToFrame(const Bounds& scene, const Layout& layout, const std::set<CellId>& selection) {
  WalkableBox box =
      boxOf(layout.regions, [&](const Region& region) { return selection.contains(region.id); });
  if (empty(box)) box = walkableBox(layout).value_or(nothing());
  if (!empty(box)) return {{box.low, layout.spec.floorHeight}, {box.high, layout.eyeZ()}};
  if (scene.empty()) return {glm::dvec3(-5), glm::dvec3(5)};
  return {glm::dvec3(scene.min), glm::dvec3(scene.max)};
}

}  // namespace acentric::editor
