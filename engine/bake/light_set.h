#pragma once
/// The scene's punctual lights sorted by kind, as one plan wants them: a kind that is off has an empty list.
/// Units are glTF's: lux for directional lights, candela for point and spot lights.

#include <glm/glm.hpp>
#include <vector>

#include "engine/scene/effect_plan.h"
#include "engine/scene/scene.h"

namespace acentric {

struct DirectionalSource {
  glm::vec3 towards;     ///< unit, to the light
  glm::vec3 irradiance;  ///< lux, facing the light
};

struct LocalSource {
  glm::vec3 position;
  glm::vec3 intensity;            ///< candela
  float inverseRangeSquared = 0;  ///< 0 = unlimited
  // Spots alone: attenuation = clamp(cosine * scale + offset)^2.
  glm::vec3 axis{0, 0, -1};  ///< unit, the way the light travels
  float coneScale = 0;
  float coneOffset = 1;
};

struct LightSet {
  std::vector<DirectionalSource> directional;
  std::vector<LocalSource> point;
  std::vector<LocalSource> spot;
  bool empty() const { return directional.empty() && point.empty() && spot.empty(); }
};

LightSet lightSet(const Scene& scene, const EffectPlan& plan);

/// Irradiance on a surface that faces the light, by KHR_lights_punctual: inverse square with the range's
/// window, and the spot's cone. `towards` and `distance` receive the way to the light.
glm::vec3 irradianceFrom(const LocalSource& source, const glm::vec3& at, glm::vec3& towards, float& distance);

/// Irradiance on a surface that faces each light in turn, nothing in between, summed.
glm::vec3 openIrradiance(const LightSet& lights, const glm::vec3& at);

}  // namespace acentric
