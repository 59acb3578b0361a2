#include "engine/pipeline/local_triangles.h"

#include "engine/scene/polygon_clipper.h"

namespace acentric {
namespace {

bool hasArea(const std::vector<PolygonClipper::Corner>& part) {
  for (std::size_t i = 2; i < part.size(); ++i)
    if (PolygonClipper::hasArea(part, i)) return true;
  return false;
}

/// Calls `found` with the number of each triangle that the region draws, but for those that are known.
template <class Known, class Found>
void eachLocal(const Scene& scene, const Region& region, const std::stop_token& stop, const Known& known,
               const Found& found) {
  PolygonClipper clipper(region.grown);
  std::size_t number = 0;
  for (const Mesh& mesh : scene.meshes) {
    if (stop.stop_requested()) return;
    for (const glm::uvec3& corners : mesh.triangles) {
      const std::size_t t = number++;
      if (!known(t) && hasArea(clipper.clip({mesh.positions[corners.x], mesh.positions[corners.y],
                                             mesh.positions[corners.z]})))
        found(t);
    }
  }
}

}  // namespace

std::vector<std::uint8_t> localTrianglesOf(const Scene& scene, const Region& region,
                                           const std::stop_token& stop) {
  std::vector<std::uint8_t> local(scene.triangleCount(), 0);
  const auto none = [](std::size_t) { return false; };
  eachLocal(scene, region, stop, none, [&](std::size_t t) { local[t] = 1; });
  return local;
}

LocalTriangles localTrianglesOf(const Scene& scene, const Layout& layout, const std::stop_token& stop) {
  const std::size_t count = scene.triangleCount();
  LocalTriangles out{std::vector<std::uint8_t>(count, 0), std::vector<glm::vec3>(count, glm::vec3(0))};
  for (const Region& region : layout.regions) {
    const glm::vec3 eye(glm::dvec3(region.polygon.centroid(), layout.eyeZ()));
    const auto known = [&](std::size_t t) { return out.wanted[t] != 0; };
    eachLocal(scene, region, stop, known, [&](std::size_t t) { out.wanted[t] = 1, out.viewer[t] = eye; });
  }
  return out;
}

}  // namespace acentric
