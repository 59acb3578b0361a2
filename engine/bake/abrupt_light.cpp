#include "engine/bake/abrupt_light.h"

#include <algorithm>

namespace acentric {
namespace {

constexpr float kAbrupt = 0.75f;

float largest(const glm::vec3& v) { return std::max({v.x, v.y, v.z}); }

/// Of three samples in a row.
bool bends(const HalfColour& a, const HalfColour& b, const HalfColour& c, float usual) {
  const glm::vec3 before(unpackColour(a)), here(unpackColour(b)), after(unpackColour(c));
  return largest(glm::abs(before - 2.0f * here + after)) >
         kAbrupt * std::max(usual, largest(glm::max(before, glm::max(here, after))));
}

/// Along each of the three edges.
bool isAbrupt(const HalfColour* samples, std::uint32_t resolution, float usual) {
  const auto at = [&](std::uint32_t i, std::uint32_t j) {
    return samples[surfaceSampleIndex(resolution, i, j)];
  };
  for (std::uint32_t i = 0; i <= resolution; ++i)
    for (std::uint32_t j = 0; i + j <= resolution; ++j) {
      const bool inner = i + j < resolution;
      if (inner && j > 0 && bends(at(i, j - 1), at(i, j), at(i, j + 1), usual)) return true;
      if (inner && i > 0 && bends(at(i - 1, j), at(i, j), at(i + 1, j), usual)) return true;
      if (i > 0 && j > 0 && bends(at(i - 1, j + 1), at(i, j), at(i + 1, j - 1), usual)) return true;
    }
  return false;
}

}  // namespace

float usualLight(const SurfaceLight& light) {
  double sum = 0;
  for (const HalfColour& sample : light.light) sum += largest(glm::vec3(unpackColour(sample)));
  return light.empty() ? 0 : float(sum / double(light.light.size()));
}

bool isAbrupt(const SurfaceLight& light, std::uint32_t sceneTriangle, float usual) {
  const std::uint32_t resolution = light.resolution[sceneTriangle];
  if (resolution < 2) return false;
  for (const bool back : {false, true})
    if (const HalfColour* samples = light.samplesOf(sceneTriangle, back);
        samples != nullptr && isAbrupt(samples, resolution, usual))
      return true;
  return false;
}

}  // namespace acentric
