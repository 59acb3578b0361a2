#include "editor/tools/orbit_camera.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/conventions.h"

namespace acentric::editor {

void OrbitCamera::setSize(const glm::ivec2& size) { size_ = glm::max(size, glm::ivec2(1)); }

PerspectiveView OrbitCamera::view(double scale) const {
  PerspectiveView view;
  view.eye = eye();
  view.yawRadians = yawRadians_;
  view.pitchRadians = pitchRadians_;
  view.width = std::max(1, int(std::lround(size_.x * scale)));
  view.height = std::max(1, int(std::lround(size_.y * scale)));
  const double tangent = std::tan(0.5 * kFovRadians) * std::min(1.0, double(view.width) / view.height);
  view.fovRadians = 2 * std::atan(tangent);
  return view;
}

glm::dvec3 OrbitCamera::forward() const {
  const double flat = std::cos(pitchRadians_);
  return {flat * std::cos(yawRadians_), flat * std::sin(yawRadians_), std::sin(pitchRadians_)};
}

void OrbitCamera::frame(const glm::dvec3& low, const glm::dvec3& high, bool fresh) {
  constexpr double kMargin = 1.08;
  if (fresh) yawRadians_ = 1.1, pitchRadians_ = -0.75;
  target_ = 0.5 * (low + high);
  const PerspectiveView view = this->view();
  const glm::dmat3 axes = view.viewFromWorld();
  const double focal = view.focalPixels();
  double needed = kNearest;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 at((corner & 1) ? high.x : low.x, (corner & 2) ? high.y : low.y,
                        (corner & 4) ? high.z : low.z);
    const glm::dvec3 seen = axes * (at - target_);
    needed = std::max({needed, 2 * focal * std::abs(seen.x) / size_.x - seen.z,
                       2 * focal * std::abs(seen.y) / size_.y - seen.z});
  }
  distance_ = std::clamp(kMargin * needed, kNearest, kFarthest);
}

void OrbitCamera::orbit(const glm::dvec2& pixels) {
  yawRadians_ = std::remainder(yawRadians_ - kRadiansPerPixel * pixels.x, kTwoPi);
  pitchRadians_ =
      std::clamp(pitchRadians_ - kRadiansPerPixel * pixels.y, -kMostPitchRadians, kMostPitchRadians);
}

void OrbitCamera::pan(const glm::dvec2& pixels, const glm::dvec3& held) {
  const PerspectiveView view = this->view();
  const glm::dmat3 axes = view.viewFromWorld();
  const double depth = std::max((axes * (held - view.eye)).z, kNearest);
  target_ -= glm::transpose(axes) * glm::dvec3(pixels * (depth / view.focalPixels()), 0);
}

void OrbitCamera::dolly(double factor, const glm::dvec3& towards) {
  const double kept = std::clamp(distance_ * factor, kNearest, kFarthest) / distance_;
  target_ = towards + kept * (target_ - towards);
  distance_ *= kept;
}

glm::dvec3 OrbitCamera::rayThrough(const glm::dvec2& pixel) const {
  return view().rayThrough(pixel.x, pixel.y);
}

glm::dvec3 OrbitCamera::besideTarget(const glm::dvec2& pixel) const {
  const glm::dvec3 ray = rayThrough(pixel);
  return eye() + ray * (distance_ / std::max(glm::dot(ray, forward()), 1e-3));
}

Projected project(const PerspectiveView& view, const glm::dvec3& point) {
  const glm::dvec3 seen = view.viewFromWorld() * (point - view.eye);
  const double scale = view.focalPixels() / std::max(std::abs(seen.z), 1e-12);
  return {{0.5 * view.width + scale * seen.x, 0.5 * view.height + scale * seen.y}, seen.z};
}

}  // namespace acentric::editor
