#include "engine/bake/surface_planes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <unordered_map>
#include <vector>

namespace acentric {
namespace {

constexpr double kEdgeOn = 1e-3;  ///< cosine
constexpr double kPerDistanceStep = 4, kLeastSteps = 64;

SurfacePlane rounded(SurfacePlane plane, double step) {
  const glm::dvec3 normal(plane.normal);
  const double size = std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)});
  if (step > 0 && size > kLeastSteps * step && size < 1e9 * step)
    plane.normal = glm::vec3(glm::round(normal / step) * step);
  for (int k = 0; k < 3; ++k) plane.normal[k] += 0.0f;  // no -0
  return plane;
}

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

SurfacePlane imagePlaneOf(const Scene& scene, const Hit& hit, const FlatMirror& mirror,
                          const glm::dvec3& centre, const glm::dvec3& way) {
  const Mesh& mesh = scene.meshes[hit.mesh];
  const glm::dvec3 corner(mesh.positions[mesh.triangles[hit.triangle].x]),
      normal(triangleNormal(mesh, hit.triangle));
  return planeThrough(mirror.reflected(normal), mirror.imageOf(corner) - centre, way);
}

void numberPlanes(CaptureSamples& samples, double distanceStep) {
  const auto bitsOf = [](const SurfacePlane& plane) {
    return std::bit_cast<std::array<std::uint32_t, 4>>(plane);
  };
  const auto hash = [&](const SurfacePlane& plane) {
    std::size_t sum = 0;
    for (const std::uint32_t bits : bitsOf(plane)) sum = (sum ^ bits) * 0x9e3779b97f4a7c15u, sum ^= sum >> 29;
    return sum;
  };
  const auto same = [&](const SurfacePlane& a, const SurfacePlane& b) { return bitsOf(a) == bitsOf(b); };
  std::unordered_map<SurfacePlane, std::uint32_t, decltype(hash), decltype(same)> numbers(1024, hash, same);
  constexpr std::uint32_t kUnmet = ~0u;
  std::vector<std::uint32_t> now(samples.planes.size(), kUnmet);
  std::vector<SurfacePlane> planes;
  for (std::uint32_t& plane : samples.plane) {
    std::uint32_t& number = now[plane];
    if (number == kUnmet) {
      const auto [met, isNew] = numbers.try_emplace(
          rounded(samples.planes[plane], distanceStep / kPerDistanceStep), std::uint32_t(planes.size()));
      if (isNew) planes.push_back(met->first);
      number = met->second;
    }
    plane = number;
  }
  samples.planes = std::move(planes);
}

}  // namespace acentric
