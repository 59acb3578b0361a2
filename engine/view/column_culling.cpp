#include "engine/view/column_culling.h"

#include <algorithm>
#include <cmath>

namespace acentric {
namespace {

constexpr double kSlack = 1e-6;  // the kernels compute in float

}  // namespace

FrustumPlanes frustumPlanes(const PerspectiveView& view, const PixelRect& rect, double margin) {
  const double focal = view.focalPixels();
  const glm::dvec2 centre(0.5 * view.width, 0.5 * view.height);
  const glm::dmat3 worldFromView = glm::transpose(view.viewFromWorld());
  const std::array<glm::dvec3, 5> inView{
      glm::dvec3(focal, 0, centre.x - (rect.x0 - margin)), glm::dvec3(-focal, 0, rect.x1 + margin - centre.x),
      glm::dvec3(0, focal, centre.y - (rect.y0 - margin)), glm::dvec3(0, -focal, rect.y1 + margin - centre.y),
      glm::dvec3(0, 0, 1)};
  FrustumPlanes planes;
  for (std::size_t i = 0; i < inView.size(); ++i)
    planes.normals[i] = worldFromView * glm::normalize(inView[i]);
  return planes;
}

std::optional<TangentRange> visibleTangents(const FrustumPlanes& planes, const glm::dvec2& columnDirection,
                                            const glm::dvec3& baseline, const glm::dvec2& range,
                                            const TangentRange& all) {
  if (range.x > range.y) return std::nullopt;
  TangentRange visible = all;
  const double reach = 1 + range.y * glm::length(baseline);
  for (const glm::dvec3& normal : planes.normals) {
    const double perInverseDistance = glm::dot(normal, baseline);
    const double best = glm::dot(glm::dvec2(normal), columnDirection) +
                        std::max(range.x * perInverseDistance, range.y * perInverseDistance) + kSlack * reach;
    // best + t * normal.z >= 0
    if (std::abs(normal.z) < 1e-12) {
      if (best < 0) return std::nullopt;
    } else if (normal.z > 0) {
      visible.low = std::max(visible.low, -best / normal.z);
    } else {
      visible.high = std::min(visible.high, -best / normal.z);
    }
    if (!(visible.low <= visible.high)) return std::nullopt;
  }
  return visible;
}

}  // namespace acentric
