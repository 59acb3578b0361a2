#include "engine/scene/up_axis_guess.h"

#include <limits>

namespace acentric {
namespace {

// A corridor's long walls have up to half as much area again as its floor and ceiling.
constexpr double kPlain = 1.6;
constexpr std::size_t kMostOfInstances = 2'000'000;
constexpr double kMost = 1000;  // times more, at which figures end

}  // namespace

std::optional<double> levelAlongZ(const SourceScene& scene) {
  glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  glm::dvec3 facing(0);  // area by axis; a slope counts for each in part
  const auto add = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    low = glm::min(low, glm::min(a, glm::min(b, c)));
    high = glm::max(high, glm::max(a, glm::max(b, c)));
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double twiceArea = glm::length(normal);
    if (twiceArea > 0) facing += normal * normal / twiceArea;
  };
  for (const SourceMesh& mesh : scene.meshes)
    for (const glm::uvec3& t : mesh.triangles)
      add(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]);
  // Of instances as many triangles as tell, spread over them all.
  std::size_t all = 0;
  for (const SourceInstance& instance : scene.instances)
    all += scene.prototypes[instance.prototype].triangles.size();
  const std::size_t step = 1 + all / kMostOfInstances;
  std::size_t next = 0;
  for (const SourceInstance& instance : scene.instances) {
    const SourceMesh& mesh = scene.prototypes[instance.prototype];
    const auto at = [&](std::uint32_t corner) {
      return glm::dvec3(instance.worldFromMesh * glm::dvec4(mesh.positions[corner], 1));
    };
    for (; next < mesh.triangles.size(); next += step) {
      const glm::uvec3& t = mesh.triangles[next];
      add(at(t.x), at(t.y), at(t.z));
    }
    next -= mesh.triangles.size();
  }
  const glm::dvec3 size = high - low;
  // A single sheet is as likely a picture on a wall as a floor.
  if (!(size.y > 0 && size.z > 0) || size.z > size.y || !(facing.z > kPlain * facing.y)) return std::nullopt;
  return facing.y > 0 ? std::min(kMost, facing.z / facing.y) : kMost;
}

}  // namespace acentric
