#include "engine/scene/surface_light.h"

namespace acentric {

SurfaceCell surfaceCellAt(std::uint32_t resolution, glm::vec2 barycentric) {
  const std::uint32_t r = resolution;
  float x = glm::clamp(barycentric.x, 0.0f, 1.0f) * float(r);
  float y = glm::clamp(barycentric.y, 0.0f, 1.0f) * float(r);
  if (const float excess = x + y - float(r); excess > 0) {
    x = glm::max(0.0f, x - 0.5f * excess);
    y = glm::min(glm::max(0.0f, y - 0.5f * excess), float(r) - x);
  }
  std::uint32_t i = glm::min(std::uint32_t(x), r - 1);
  std::uint32_t j = glm::min(std::uint32_t(y), r - 1);
  if (i + j > r - 1) (i > j ? i : j) = r - 1 - (i > j ? j : i);  // on the slanted side: its last whole cell
  const float fx = x - float(i);
  const float fy = y - float(j);
  if (fx + fy <= 1 || i + j + 2 > r) return {{{i, j}, {i + 1, j}, {i, j + 1}}, {1 - fx - fy, fx, fy}};
  return {{{i + 1, j + 1}, {i + 1, j}, {i, j + 1}}, {fx + fy - 1, 1 - fy, 1 - fx}};
}

glm::vec2 surfaceSamplePlace(std::uint32_t resolution, std::uint32_t i, std::uint32_t j) {
  constexpr float kNudge = 0.1f;
  const glm::vec2 exact(float(i) / float(resolution), float(j) / float(resolution));
  return glm::mix(exact, glm::vec2(1.0f / 3), kNudge / float(resolution));
}

const HalfColour* SurfaceLight::samplesOf(std::uint32_t sceneTriangle, bool back) const {
  const HalfColour* const front = light.data() + firstSample[sceneTriangle];
  if (!back) return front;
  return hasBack[sceneTriangle] ? front + surfaceSampleCount(resolution[sceneTriangle]) : nullptr;
}

glm::vec3 SurfaceLight::at(std::uint32_t sceneTriangle, glm::vec2 barycentric, bool back) const {
  const std::uint32_t r = resolution[sceneTriangle];
  const HalfColour* const samples = r > 0 ? samplesOf(sceneTriangle, back) : nullptr;
  return samples != nullptr ? interpolatedLight(samples, r, barycentric) : glm::vec3(0);
}

glm::vec3 interpolatedLight(const HalfColour* samples, std::uint32_t resolution, glm::vec2 barycentric) {
  const SurfaceCell cell = surfaceCellAt(resolution, barycentric);
  glm::vec3 sum(0);
  for (int c = 0; c < 3; ++c) {
    const HalfColour& at = samples[surfaceSampleIndex(resolution, cell.sample[c].x, cell.sample[c].y)];
    sum += cell.weight[c] * glm::vec3(floatFromHalf(at.r), floatFromHalf(at.g), floatFromHalf(at.b));
  }
  return sum;
}

}  // namespace acentric
