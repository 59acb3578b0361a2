#pragma once
/// The scene's lights sorted by kind, as one plan wants them: a kind that is off has an empty list. Lights
/// with a size are apart, and among the others where the plan has soft shadows off. Units are glTF's: lux for
/// directional lights, candela for point and spot lights.

#include <glm/glm.hpp>
#include <vector>

#include "engine/scene/effect_plan.h"
#include "engine/scene/scene.h"

namespace acentric {

struct DirectionalSource {
  glm::vec3 towards;     ///< unit, to the light
  glm::vec3 irradiance;  ///< lux, facing the light
  float cosine = 1;      ///< of the half angle it fills
};

struct LocalSource {
  glm::vec3 position;
  glm::vec3 intensity;            ///< candela
  float inverseRangeSquared = 0;  ///< 0 = unlimited
  // Spots alone: attenuation = clamp(cosine * scale + offset)^2.
  glm::vec3 axis{0, 0, -1};  ///< unit, the way the light travels
  float coneScale = 0;
  float coneOffset = 1;
  float radius = 0;  ///< metres
};

struct LightSet {
  std::vector<DirectionalSource> directional;
  std::vector<LocalSource> point;
  std::vector<LocalSource> spot;
  std::vector<DirectionalSource> wideDirectional;  ///< with a size
  std::vector<LocalSource> wideLocal;              ///< points and spots with a size
  bool hasSmall() const { return !directional.empty() || !point.empty() || !spot.empty(); }
  bool hasWide() const { return !wideDirectional.empty() || !wideLocal.empty(); }
  bool empty() const { return !hasSmall() && !hasWide(); }
};

LightSet lightSet(const Scene& scene, const EffectPlan& plan);

/// Irradiance on a surface that faces the light, by KHR_lights_punctual: inverse square with the range's
/// window, and the spot's cone. `towards` and `distance` receive the way to the light.
glm::vec3 irradianceFrom(const LocalSource& source, const glm::vec3& at, glm::vec3& towards, float& distance);

/// Irradiance on a surface that faces each light in turn, nothing in between, summed.
glm::vec3 openIrradiance(const LightSet& lights, const glm::vec3& at);

}  // namespace acentric
