#include "engine/scene/up_axis_guess.h"

#include <limits>

namespace acentric {
namespace {

// A corridor's long walls have up to half as much area again as its floor and ceiling.
constexpr double kPlain = 1.6;
constexpr double kMost = 1000;  // times more, at which figures end

}  // namespace

std::optional<double> levelAlongZ(const std::vector<SourceMesh>& meshes) {
  glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  glm::dvec3 facing(0);  // area by axis; a slope counts for each in part
  for (const SourceMesh& mesh : meshes)
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::dvec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
      low = glm::min(low, glm::min(a, glm::min(b, c)));
      high = glm::max(high, glm::max(a, glm::max(b, c)));
      const glm::dvec3 normal = glm::cross(b - a, c - a);
      const double twiceArea = glm::length(normal);
      if (twiceArea > 0) facing += normal * normal / twiceArea;
    }
  const glm::dvec3 size = high - low;
  // A single sheet is as likely a picture on a wall as a floor.
  if (!(size.y > 0 && size.z > 0) || size.z > size.y || !(facing.z > kPlain * facing.y)) return std::nullopt;
  return facing.y > 0 ? std::min(kMost, facing.z / facing.y) : kMost;
}

}  // namespace acentric
