#include "engine/bake/surface_planes.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/image/plane_numbers.h"

namespace acentric {
namespace {

constexpr double kEdgeOn = 1e-3;  ///< cosine
/// Steps that the largest part of a plane that is rounded has.
constexpr double kLeastSteps = 64;

SurfacePlane rounded(SurfacePlane plane, double step) {
  const glm::dvec3 normal(plane.normal);
  const double size = std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)});
  if (step > 0 && size > kLeastSteps * step && size < 1e9 * step)
    plane.normal = glm::vec3(glm::round(normal / step) * step);
  for (int k = 0; k < 3; ++k) plane.normal[k] += 0.0f;  // no -0: equal planes have equal bytes
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
  const PlacedMesh placed(scene, hit.mesh);
  const glm::dvec3 corner(placed.position(placed.mesh().triangles[hit.triangle].x));
  SurfacePlane plane = planeThrough(glm::dvec3(triangleNormal(placed, hit.triangle)), corner - centre,
                                    double(hit.distance) * glm::dvec3(direction));
  plane.away = away ? 1 : 0;
  return plane;
}

SurfacePlane imagePlaneOf(const Scene& scene, const Hit& hit, const FlatMirror& mirror,
                          const glm::dvec3& centre, const glm::dvec3& way, bool away) {
  const PlacedMesh placed(scene, hit.mesh);
  const glm::dvec3 corner(placed.position(placed.mesh().triangles[hit.triangle].x)),
      normal(triangleNormal(placed, hit.triangle));
  SurfacePlane plane = planeThrough(mirror.reflected(normal), mirror.imageOf(corner) - centre, way);
  plane.away = away ? 1 : 0;
  return plane;
}

void numberPlanes(CaptureSamples& samples, double distanceStep) {
  const auto hash = [](const SurfacePlane& plane) {
    return std::hash<std::string_view>()({reinterpret_cast<const char*>(&plane), sizeof plane});
  };
  std::unordered_map<SurfacePlane, std::uint32_t, decltype(hash)> numbers(1024, hash);
  constexpr std::uint32_t kUnmet = ~0u;
  std::vector<std::uint32_t> now(samples.planes.size(), kUnmet);
  std::vector<SurfacePlane> planes;
  for (std::uint32_t& plane : samples.plane) {
    std::uint32_t& number = now[plane];
    if (number == kUnmet) {
      const auto [met, isNew] = numbers.try_emplace(rounded(samples.planes[plane], planeStep(distanceStep)),
                                                    std::uint32_t(planes.size()));
      if (isNew) planes.push_back(met->first);
      number = met->second;
    }
    plane = number;
  }
  samples.planes = std::move(planes);
}

}  // namespace acentric
