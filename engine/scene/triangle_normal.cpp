#include "engine/scene/triangle_normal.h"

#include <cmath>

namespace acentric {

glm::vec3 unitNormal(const glm::dvec3& across) {
  const double length = glm::length(across);
  return length > 0 && std::isfinite(length) ? glm::vec3(across / length) : glm::vec3(0, 0, 1);
}

glm::vec3 triangleNormal(const Mesh& mesh, std::uint32_t triangle) {
  const glm::uvec3& t = mesh.triangles[triangle];
  const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
  return unitNormal(glm::cross(b - a, c - a));
}

glm::vec3 triangleNormal(const PlacedMesh& placed, std::uint32_t triangle) {
  if (!placed.isInstance()) return triangleNormal(placed.mesh(), triangle);
  const auto corners = placed.corners(triangle);
  const glm::dvec3 a(corners[0]), b(corners[1]), c(corners[2]);
  const glm::dvec3 across = glm::cross(b - a, c - a);
  return unitNormal(placed.mirrored() ? -across : across);
}

}  // namespace acentric
