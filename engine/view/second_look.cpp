#include "engine/view/second_look.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/conventions.h"
#include "engine/view/patch_kernel.h"

namespace acentric {

SurfacePixel SurfacePixel::onPlane(const glm::dvec3& normal, double zDepth, const glm::dvec3& ray,
                                   const glm::dvec3& rayAcross, const glm::dvec3& rayDown) {
  const double rate = 1 / glm::dot(normal, ray);
  const auto moved = [&](const glm::dvec3& step) {
    return zDepth * (step - glm::dot(normal, step) * rate * ray);
  };
  return {zDepth * ray, moved(rayAcross), moved(rayDown)};
}

double densityAt(const SurfacePixel& pixel, const glm::dvec3& baseline, double columnsPerRadian,
                 double rowsPerRadian) {
  const glm::dvec3 d = pixel.place - baseline;
  const double flat = d.x * d.x + d.y * d.y, distance = std::sqrt(flat);
  const double perColumn = columnsPerRadian / flat, perRow = rowsPerRadian / ((flat + d.z * d.z) * distance);
  const auto texels = [&](const glm::dvec3& step) {
    return glm::dvec2((d.x * step.y - d.y * step.x) * perColumn,
                      (flat * step.z - d.z * (d.x * step.x + d.y * step.y)) * perRow);
  };
  const glm::dvec2 across = texels(pixel.across), down = texels(pixel.down);
  const double squares = glm::dot(across, across) + glm::dot(down, down);
  return std::abs(across.x * down.y - across.y * down.x) / std::sqrt(std::max(squares, 1e-20));
}

SecondLook::SecondLook(const WalkScene& scene, std::span<const PieceDraw> behind) {
  for (const PieceDraw& piece : behind) {
    const auto& capture = scene.captures[std::size_t(piece.camera)];
    if (capture == nullptr || capture->patches == nullptr) continue;
    const ColumnCamera& camera = capture->camera;
    const double half = 0.5 * camera.fovRadians + 2 * camera.columnPitch();
    cameras_.push_back({glm::dvec3(piece.baseline), camera.directionAt(0.5 * camera.columns),
                        half < kPi ? std::cos(half) : -1, 1 / camera.columnPitch(), 1 / camera.rowPitch()});
  }
}

bool SecondLook::isWorth(const SurfacePixel& pixel, double density) const {
  return std::ranges::any_of(cameras_, [&](const Camera& camera) {
    const glm::dvec2 d(pixel.place - camera.baseline);
    return glm::dot(d, camera.middle) >= camera.leastCosine * glm::length(d) &&
           densityAt(pixel, camera.baseline, camera.columnsPerRadian, camera.rowsPerRadian) >
               double(kDenser) * density;
  });
}

}  // namespace acentric
