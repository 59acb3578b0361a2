#include "engine/scene/default_light.h"

#include <fmt/format.h>

#include <algorithm>

namespace acentric {
namespace {

/// Illuminance of the default sun on a surface that faces it.
constexpr float kSunIlluminance = 3.0f;

/// Sky radiance for a sun of illuminance 1: blue above, paler at the horizon, a warm bounce from below. On
/// the average a sixth of the sun's figure, about what a clear day has.
constexpr glm::vec3 kZenith{0.10f, 0.14f, 0.20f};
constexpr glm::vec3 kHorizon{0.15f, 0.17f, 0.19f};
constexpr glm::vec3 kGround{0.052f, 0.050f, 0.047f};

Sky skyFor(float illuminance) {
  return {kZenith * illuminance, kHorizon * illuminance, kGround * illuminance};
}

Light defaultSun() {
  Light sun;
  sun.name = "default sun";
  sun.colour = glm::vec3(1.0f, 0.96f, 0.90f);
  sun.intensity = kSunIlluminance;
  sun.direction = glm::normalize(glm::vec3(0.45f, 0.30f, -0.84f));  // high, from the south-west
  return sun;
}

bool shines(const Light& light) { return light.intensity > 0 && light.colour != glm::vec3(0); }

float strongestChannel(const Light& light) {
  return light.intensity * std::max({light.colour.r, light.colour.g, light.colour.b});
}

}  // namespace

void addDefaultLight(Scene& scene, bool allowed, ReportLines& guessed) {
  if (!std::any_of(scene.lights.begin(), scene.lights.end(), shines)) {
    if (!allowed) {
      guessed.add("no lights: only what emits or is unlit can be seen");
      return;
    }
    scene.lights.push_back(defaultSun());
    scene.sky = skyFor(kSunIlluminance);
    guessed.add("no lights: a sun and sky were added");
    return;
  }
  float sun = 0;
  for (const Light& light : scene.lights)
    if (light.kind == LightKind::directional) sun += strongestChannel(light);
  if (sun > 0 && allowed) {
    scene.sky = skyFor(sun);
    guessed.add("no sky: one was added in proportion to the directional light");
  }
}

}  // namespace acentric
