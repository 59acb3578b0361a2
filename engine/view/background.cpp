#include "engine/view/background.h"

#include <algorithm>
#include <cmath>

#include "engine/view/sky_table.h"

namespace acentric {

bool BackgroundLimits::holds(const glm::vec3& direction) const {
  const float flat = std::sqrt(direction.x * direction.x + direction.y * direction.y);
  return direction.z > above * flat || direction.z < below * flat;
}

BackgroundLimits backgroundLimits(const WalkScene& scene, const glm::dvec3& eye) {
  BackgroundLimits limits;
  if (!scene.scene || scene.scene->bounds.empty() || !scene.layout) return limits;
  const double across = scene.layout->spec.nearBand;
  if (!(across > 0)) return limits;
  const Bounds& bounds = scene.scene->bounds;
  // Captures reach to the horizon at least, and where they end early the rest is a hole, not background.
  const auto steepest = [&](double z) { return (z - eye.z) / across; };
  limits.above = float(std::max(0.0, steepest(double(bounds.max.z))));
  limits.below = float(std::min(0.0, steepest(double(bounds.min.z))));
  for (const auto& capture : scene.captures) {
    if (!capture || capture->rowTangent.empty()) continue;
    limits.above = std::max(limits.above, float(std::tan(capture->camera.topElevation)));
    limits.below = std::min(limits.below, float(std::tan(capture->camera.bottomElevation)));
    break;  // all cameras of a layout have the same rows
  }
  return limits;
}

glm::dvec3 directionThrough(const PerspectiveView& view, double u, double v) {
  return glm::transpose(view.viewFromWorld()) *
         glm::dvec3(u - 0.5 * view.width, v - 0.5 * view.height, view.focalPixels());
}

bool showsBackground(const BackgroundLimits& limits, const PerspectiveView& view) {
  if (!std::isfinite(limits.above) && !std::isfinite(limits.below)) return false;
  // A picture that does not hold the zenith or the nadir is steepest on its border.
  const glm::dmat3 viewFromWorld = view.viewFromWorld();
  for (const double up : {1.0, -1.0}) {
    const glm::dvec3 pole = viewFromWorld * glm::dvec3(0, 0, up);
    const double focal = view.focalPixels();
    if (pole.z > 0 && std::abs(pole.x / pole.z) * focal <= 0.5 * view.width &&
        std::abs(pole.y / pole.z) * focal <= 0.5 * view.height)
      return true;
  }
  const auto shown = [&](int x, int y) { return limits.holds(glm::vec3(view.rayThrough(x, y))); };
  for (int x = 0; x <= view.width; ++x)
    if (shown(x, 0) || shown(x, view.height)) return true;
  for (int y = 0; y <= view.height; ++y)
    if (shown(0, y) || shown(view.width, y)) return true;
  return false;
}

Sky backgroundSky(const WalkScene& scene) { return scene.plan.on(Effect::sky) ? scene.scene->sky : Sky{}; }

void paintBackground(const SkyTable& sky, const PerspectiveView& view, const BackgroundLimits& limits,
                     std::uint32_t slot, Canvas& canvas) {
  for (int x = canvas.x0; x < canvas.x0 + canvas.width; ++x) {
    CanvasPixel* const column = canvas.column(x);
    const glm::dvec3 first = directionThrough(view, x + 0.5, 0.5);
    const glm::dvec3 step = directionThrough(view, x + 0.5, 1.5) - first;
    for (int y = 0; y < view.height; ++y) {
      const glm::vec3 direction(first + double(y) * step);
      if (limits.holds(direction)) column[y] = canvasPixel(sky.towards(direction) | slot << 24, 0);
    }
  }
}

}  // namespace acentric
