#include "engine/inspect/surface_points.h"

#include <algorithm>
#include <cmath>

#include "engine/base/contract.h"

namespace acentric {

SurfacePoints::SurfacePoints(ScenePtr scene) : scene_(std::move(scene)) {
  double area = 0;
  for (std::uint32_t m = 0; m < scene_->meshes.size(); ++m) {
    const Mesh& mesh = scene_->meshes[m];
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const glm::uvec3& corners = mesh.triangles[t];
      const glm::dvec3 a(mesh.positions[corners.x]), b(mesh.positions[corners.y]),
          c(mesh.positions[corners.z]);
      const double own = 0.5 * glm::length(glm::cross(b - a, c - a));
      if (!(own > 0) || !std::isfinite(own)) continue;
      area += own;
      triangles_.push_back({m, t});
      area_.push_back(area);
    }
  }
}

SurfacePoint SurfacePoints::at(std::uint64_t n) const {
  require(!area_.empty(), "the scene has surfaces");
  // Powers of the root of x^4 = x + 1: the generalised golden ratio for three dimensions.
  constexpr double kRoot = 1.2207440846057596;
  constexpr double kSteps[3] = {1 / kRoot, 1 / (kRoot * kRoot), 1 / (kRoot * kRoot * kRoot)};
  const auto place = [&](int dimension) { return std::fmod(0.5 + double(n + 1) * kSteps[dimension], 1.0); };
  const auto found = std::ranges::upper_bound(area_, place(0) * area_.back());
  const std::size_t index = std::min(std::size_t(found - area_.begin()), area_.size() - 1);
  double u = place(1), v = place(2);
  if (u + v > 1) u = 1 - u, v = 1 - v;
  const Ref& ref = triangles_[index];
  const Mesh& mesh = scene_->meshes[ref.mesh];
  const glm::uvec3& corners = mesh.triangles[ref.triangle];
  const glm::dvec3 a(mesh.positions[corners.x]), b(mesh.positions[corners.y]), c(mesh.positions[corners.z]);
  return {a + u * (b - a) + v * (c - a), glm::normalize(glm::cross(b - a, c - a)), ref.mesh, ref.triangle};
}

}  // namespace acentric
