#include "engine/scene/local_geometry.h"

#include <limits>

#include "engine/base/contract.h"
#include "engine/scene/drawn_scene.h"
#include "engine/scene/polygon_clipper.h"

namespace acentric {
namespace {

void addClipped(const Scene& scene, std::uint32_t mesh, std::uint32_t triangle, PolygonClipper& clipper,
                LocalGeometry& out) {
  const Mesh& source = scene.meshes[mesh];
  const glm::uvec3& at = source.triangles[triangle];
  const auto& corners =
      clipper.clip({source.positions[at.x], source.positions[at.y], source.positions[at.z]});
  const std::uint32_t first = std::uint32_t(out.vertices.size());
  bool any = false;
  for (std::size_t i = 2; i < corners.size(); ++i) {
    if (!PolygonClipper::hasArea(corners, i)) continue;
    out.triangles.push_back(
        {{first, first + std::uint32_t(i) - 1, first + std::uint32_t(i)}, mesh, triangle});
    any = true;
  }
  if (!any) return;
  for (const PolygonClipper::Corner& corner : corners)
    out.vertices.push_back({glm::vec3(corner.position), glm::vec2(corner.barycentric)});
}

}  // namespace

LocalGeometry clipToPolygon(const Scene& scene, const ConvexPolygon& polygon, std::span<const Bounds> boxes) {
  LocalGeometry out;
  out.polygon = polygon;
  PolygonClipper clipper(polygon);
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    if (!boxes.empty() && clipper.misses(boxes[m])) continue;
    for (std::size_t t = 0; t < scene.meshes[m].triangles.size(); ++t)
      addClipped(scene, std::uint32_t(m), std::uint32_t(t), clipper, out);
  }
  require(out.vertices.size() <= std::numeric_limits<std::uint32_t>::max(),
          "local geometry has less than 2^32 vertices");
  return out;
}

LocalGeometry clipToPolygon(const DrawnScene& drawn, const ConvexPolygon& polygon) {
  return clipToPolygon(drawn.scene(), polygon, drawn.boxes());
}

}  // namespace acentric
