#include "editor/session/scene_view.h"

#include <algorithm>
#include <limits>

#include "engine/bake/flush_denormals.h"

namespace acentric::editor {

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

SceneBox boxToFrame(const Bounds& scene, const Layout& layout, const std::set<CellId>& selection) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  glm::dvec2 low(kInfinity), high(-kInfinity);
  const auto add = [&](const ConvexPolygon& polygon) {
    for (const glm::dvec2& corner : polygon.corners)
      low = glm::min(low, corner), high = glm::max(high, corner);
  };
  for (const CellId& cell : selection)
    if (const auto region = layout.findRegion(cell)) add(layout.regions[std::size_t(*region)].polygon);
  if (low.x > high.x)
    for (const Region& region : layout.regions) add(region.polygon);
  if (low.x <= high.x) return {{low.x, low.y, layout.spec.floorHeight}, {high.x, high.y, layout.eyeZ()}};
  if (scene.empty()) return {glm::dvec3(-5), glm::dvec3(5)};
  return {glm::dvec3(scene.min), glm::dvec3(scene.max)};
}

}  // namespace acentric::editor
