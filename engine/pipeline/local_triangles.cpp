#include "engine/pipeline/local_triangles.h"

#include "engine/scene/polygon_clipper.h"

namespace acentric {
namespace {

bool hasArea(const std::vector<PolygonClipper::Corner>& part) {
  for (std::size_t i = 2; i < part.size(); ++i)
    if (PolygonClipper::hasArea(part, i)) return true;
  return false;
}

}  // namespace

LocalTriangles localTrianglesOf(const Scene& scene, const Layout& layout, const std::stop_token& stop) {
  const auto first = scene.firstTriangles();
  LocalTriangles out{std::vector<std::uint8_t>(first.back(), 0),
                     std::vector<glm::vec3>(first.back(), glm::vec3(0))};
  for (const Region& region : layout.regions) {
    const glm::vec3 eye(glm::dvec3(region.polygon.centroid(), layout.eyeZ()));
    PolygonClipper clipper(region.grown);
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
      if (stop.stop_requested()) return out;
      const Mesh& mesh = scene.meshes[m];
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const std::size_t number = first[m] + t;
        if (out.wanted[number] != 0) continue;
        const glm::uvec3& corners = mesh.triangles[t];
        if (!hasArea(clipper.clip(
                {mesh.positions[corners.x], mesh.positions[corners.y], mesh.positions[corners.z]})))
          continue;
        out.wanted[number] = 1;
        out.viewer[number] = eye;
      }
    }
  }
  return out;
}

}  // namespace acentric
