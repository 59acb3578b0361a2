#include "engine/bake/surface_planes.h"

#include <cmath>

namespace acentric {
namespace {

constexpr double kEdgeOn = 1e-3;  ///< cosine

/// Through centre + `way`, with a unit normal; `corner`: another of its points, or the same.
SurfacePlane planeThrough(const glm::dvec3& normal, const glm::dvec3& corner, const glm::dvec3& way) {
  const double height = glm::dot(normal, corner), distance = glm::length(way);
  if (!(std::abs(height) > kEdgeOn * distance)) return {glm::vec3(way / (distance * distance))};
  return {glm::vec3(normal / height)};
}

}  // namespace

SurfacePlane planeOf(const Scene& scene, const Hit& hit, const glm::dvec3& centre, const glm::vec3& direction,
                     bool away) {
  const Mesh& mesh = scene.meshes[hit.mesh];
  const glm::dvec3 corner(mesh.positions[mesh.triangles[hit.triangle].x]);
  SurfacePlane plane = planeThrough(glm::dvec3(triangleNormal(mesh, hit.triangle)), corner - centre,
                                    double(hit.distance) * glm::dvec3(direction));
  plane.away = away ? 1 : 0;
  return plane;
}

SurfacePlane imagePlaneOf(const Hit& hit, const glm::vec3& mirrorNormal, const glm::dvec3& way) {
  return planeThrough(glm::dvec3(glm::reflect(hit.geometricNormal(), mirrorNormal)), way, way);
}

}  // namespace acentric
