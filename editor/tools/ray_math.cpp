#include "editor/tools/ray_math.h"

#include <algorithm>
#include <cmath>

namespace acentric::editor {
namespace {

/// As near to the eye as anything is drawn, of the farther end's distance along the axis.
constexpr double kNearShare = 1e-3;

glm::dvec2 pixelOf(const PerspectiveView& view, const glm::dvec3& seen) {
  const double scale = view.focalPixels() / seen.z;
  return {0.5 * view.width + scale * seen.x, 0.5 * view.height + scale * seen.y};
}

}  // namespace

PointerRay rayThrough(const PerspectiveView& view, const glm::dvec2& pixel) {
  return {view.eye, view.rayThrough(pixel.x, pixel.y)};
}

std::optional<glm::dvec2> onLevel(const PointerRay& ray, double height) {
  if (!(std::abs(ray.way.z) >= kLeastPlaneSine)) return std::nullopt;
  const double distance = (height - ray.from.z) / ray.way.z;
  if (!(distance > 0)) return std::nullopt;
  return glm::dvec2(ray.from + distance * ray.way);
}

std::optional<double> alongLine(const PointerRay& ray, const glm::dvec3& origin, const glm::dvec3& axis) {
  const double cosine = glm::dot(ray.way, axis), sine2 = 1 - cosine * cosine;
  if (!(sine2 >= kLeastLineSine * kLeastLineSine)) return std::nullopt;
  const glm::dvec3 off = origin - ray.from;
  const double onRay = glm::dot(off, ray.way), onAxis = glm::dot(off, axis);
  if (!((onRay - cosine * onAxis) / sine2 > 0)) return std::nullopt;  // nearest behind the eye
  return (cosine * onRay - onAxis) / sine2;
}

std::optional<double> azimuthAbout(const PointerRay& ray, const glm::dvec3& centre) {
  const auto place = onLevel(ray, centre.z);
  if (!place) return std::nullopt;
  const glm::dvec2 away = *place - glm::dvec2(centre);
  if (away == glm::dvec2(0)) return std::nullopt;
  return std::atan2(away.y, away.x);
}

std::optional<Stroke> strokeOf(const PerspectiveView& view, const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dmat3 axes = view.viewFromWorld();
  glm::dvec3 a = axes * (from - view.eye), b = axes * (to - view.eye);
  const double near = kNearShare * std::max(a.z, b.z);
  if (!(near > 0)) return std::nullopt;
  if (a.z < near)
    a = glm::mix(a, b, (near - a.z) / (b.z - a.z));
  else if (b.z < near)
    b = glm::mix(b, a, (near - b.z) / (a.z - b.z));
  return Stroke{pixelOf(view, a), pixelOf(view, b)};
}

std::vector<glm::dvec2> cornersBeforeEye(const PerspectiveView& view, std::span<const glm::dvec3> corners) {
  const glm::dmat3 axes = view.viewFromWorld();
  std::vector<glm::dvec3> seen;
  double farthest = 0;
  for (const glm::dvec3& corner : corners) {
    seen.push_back(axes * (corner - view.eye));
    farthest = std::max(farthest, seen.back().z);
  }
  std::vector<glm::dvec2> shown;
  const double near = kNearShare * farthest;
  if (!(near > 0)) return shown;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const glm::dvec3 &at = seen[k], &next = seen[(k + 1) % seen.size()];
    if (at.z >= near) shown.push_back(pixelOf(view, at));
    if ((at.z >= near) != (next.z >= near))
      shown.push_back(pixelOf(view, glm::mix(at, next, (near - at.z) / (next.z - at.z))));
  }
  return shown;
}

double pixelsPerMetre(const PerspectiveView& view, const glm::dvec3& place) {
  const double depth = (view.viewFromWorld() * (place - view.eye)).z;
  return depth > 0 ? view.focalPixels() / depth : 0;
}

double distanceTo(const Stroke& stroke, const glm::dvec2& pixel, double* share) {
  const glm::dvec2 along = stroke.to - stroke.from;
  const double length2 = glm::dot(along, along);
  const double at = length2 > 0 ? std::clamp(glm::dot(pixel - stroke.from, along) / length2, 0.0, 1.0) : 0.0;
  if (share != nullptr) *share = at;
  return glm::distance(stroke.from + at * along, pixel);
}

}  // namespace acentric::editor
