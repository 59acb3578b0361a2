#include "engine/geometry/perspective_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/geometry/conventions.h"

namespace acentric {

Status PerspectiveView::check() const {
  const auto bad = [](std::string message) {
    return fail(ErrorKind::invalidArgument, std::move(message), "view");
  };
  for (double value : {eye.x, eye.y, eye.z, yawRadians, pitchRadians, fovRadians})
    if (!std::isfinite(value)) return bad("eye, yaw, pitch and field of view must be finite numbers");
  if (std::abs(pitchRadians) > kPi / 2 + 1e-9) return bad("pitch must lie in -90..90 degrees");
  if (fovRadians < radians(0.1) || fovRadians > radians(179.9))
    return bad(fmt::format("field of view {:.3f} degrees: must lie in 0.1..179.9", degrees(fovRadians)));
  if (width < 1 || height < 1 || width > 16384 || height > 16384)
    return bad(fmt::format("size {}x{}: each side must lie in 1..16384 pixels", width, height));
  return {};
}

double PerspectiveView::focalPixels() const { return 0.5 * width / std::tan(0.5 * fovRadians); }

glm::dmat3 PerspectiveView::viewFromWorld() const {
  const double cy = std::cos(yawRadians), sy = std::sin(yawRadians);
  const double cp = std::cos(pitchRadians), sp = std::sin(pitchRadians);
  const glm::dvec3 right{sy, -cy, 0}, forward{cy * cp, sy * cp, sp};
  const glm::dvec3 down{cy * sp, sy * sp, -cp};
  return glm::transpose(glm::dmat3(right, down, forward));
}

glm::dvec3 PerspectiveView::rayThrough(double u, double v) const {
  const double focal = focalPixels();
  const glm::dvec3 inView{(u - 0.5 * width) / focal, (v - 0.5 * height) / focal, 1};
  return glm::normalize(glm::transpose(viewFromWorld()) * inView);
}

AzimuthRange azimuthRange(const PerspectiveView& view) {
  const glm::dmat3 m = view.viewFromWorld();
  const double focal = view.focalPixels();
  for (double z : {1.0, -1.0}) {  // does the frustum hold the zenith or the nadir?
    const glm::dvec3 pole = m * glm::dvec3(0, 0, z);
    if (pole.z > 0 && std::abs(pole.x) * focal <= 0.5 * view.width * pole.z &&
        std::abs(pole.y) * focal <= 0.5 * view.height * pole.z)
      return {0, kTwoPi};
  }
  // Azimuth along each straight image border is monotone unless the border crosses a pole's column, so the
  // extremes lie at the corners, measured relative to the viewing direction.
  double left = 0, right = 0;
  for (double u : {0.0, double(view.width)})
    for (double v : {0.0, double(view.height)}) {
      const glm::dvec3 d = view.rayThrough(u, v);
      double relative = std::atan2(d.y, d.x) - view.yawRadians;
      relative -= kTwoPi * std::round(relative / kTwoPi);
      // The left half of the picture lies counter-clockwise of the centre, even beyond 90 degrees.
      if (u == 0 && relative < 0) relative += kTwoPi;
      if (u != 0 && relative > 0) relative -= kTwoPi;
      left = std::max(left, relative);
      right = std::min(right, relative);
    }
  return {wrapAngle(view.yawRadians + right), std::min(left - right, kTwoPi)};
}

}  // namespace acentric
