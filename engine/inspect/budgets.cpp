#include "engine/inspect/budgets.h"

#include <algorithm>

#include "engine/inspect/triangle_grid.h"

namespace acentric {
namespace {

PlanBounds boundsOf(const ConvexPolygon& polygon) {
  PlanBounds bounds;
  for (const glm::dvec2& corner : polygon.corners) bounds.add(corner);
  return bounds;
}

/// Counts what clipToPolygon would give, clipping only triangles that may cross the border.
class Counter {
 public:
  Counter(const Scene& scene, TriangleGrid& grid) : scene_(scene), grid_(grid) { border_.meshes.resize(1); }

  std::size_t count(const ConvexPolygon& polygon) {
    Mesh& mesh = border_.meshes.front();
    mesh.positions.clear();
    mesh.triangles.clear();
    std::size_t inside = 0;
    for (const TriangleGrid::Triangle& triangle : grid_.near(boundsOf(polygon))) {
      const Mesh& source = scene_.meshes[triangle.mesh];
      const glm::uvec3& corners = source.triangles[triangle.index];
      const glm::vec3 a = source.positions[corners.x], b = source.positions[corners.y],
                      c = source.positions[corners.z];
      if (polygon.containsClosed(glm::dvec2(a)) && polygon.containsClosed(glm::dvec2(b)) &&
          polygon.containsClosed(glm::dvec2(c))) {
        const glm::dvec3 twiceArea = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
        inside += twiceArea != glm::dvec3(0) ? 1 : 0;
        continue;
      }
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.insert(mesh.positions.end(), {a, b, c});
      mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    return inside + clipToPolygon(border_, polygon).triangles.size();
  }

 private:
  const Scene& scene_;
  TriangleGrid& grid_;
  Scene border_;  ///< the triangles that may cross the border of the polygon at hand
};

}  // namespace

std::vector<std::size_t> countLocalTriangles(const Scene& scene, const Layout& layout) {
  std::vector<std::size_t> counts;
  if (layout.regions.empty()) return counts;
  PlanBounds area;
  for (const Region& region : layout.regions)
    for (const glm::dvec2& corner : region.grown.corners) area.add(corner);
  TriangleGrid grid(scene, area, 0.5 * layout.spec.cellSize);
  Counter counter(scene, grid);
  counts.reserve(layout.regions.size());
  for (const Region& region : layout.regions) counts.push_back(counter.count(region.grown));
  return counts;
}

}  // namespace acentric
