#include "engine/bake/light_set.h"

#include <algorithm>
#include <cmath>

namespace acentric {
namespace {

LocalSource localSource(const Light& light) {
  LocalSource source{light.position, light.colour * light.intensity};
  source.radius = light.radius;
  if (light.range > 0) source.inverseRangeSquared = 1 / (light.range * light.range);
  if (light.kind != LightKind::spot) return source;
  source.axis = light.direction;
  const float inner = std::cos(light.innerCone), outer = std::cos(light.outerCone);
  source.coneScale = 1 / std::max(0.001f, inner - outer);
  source.coneOffset = -outer * source.coneScale;
  return source;
}

}  // namespace

LightSet lightSet(const Scene& scene, const EffectPlan& plan) {
  LightSet set;
  const bool wide = plan.on(Effect::softShadows);
  for (const Light& light : scene.lights) {
    const glm::vec3 strength = light.colour * light.intensity;
    if (!(strength.x > 0 || strength.y > 0 || strength.z > 0)) continue;
    if (light.kind == LightKind::directional && plan.on(Effect::directionalLights))
      (wide && light.angularRadius > 0 ? set.wideDirectional : set.directional)
          .push_back({-light.direction, strength, std::cos(light.angularRadius)});
    if (light.kind == LightKind::point && plan.on(Effect::pointLights))
      (wide && light.radius > 0 ? set.wideLocal : set.point).push_back(localSource(light));
    if (light.kind == LightKind::spot && plan.on(Effect::spotLights))
      (wide && light.radius > 0 ? set.wideLocal : set.spot).push_back(localSource(light));
  }
  return set;
}

glm::vec3 irradianceFrom(const LocalSource& source, const glm::vec3& at, glm::vec3& towards,
                         float& distance) {
  constexpr float kClosest = 1e-7f;  // metres; a surface through the lamp itself stays finite
  const glm::vec3 way = source.position - at;
  distance = std::max(glm::length(way), kClosest);
  towards = way / distance;
  const float square = distance * distance;
  const float share = square * source.inverseRangeSquared;  // (d / range)^2, 0 if unlimited
  const float window = std::clamp(1 - share * share, 0.0f, 1.0f);
  const float cone =
      std::clamp(-glm::dot(source.axis, towards) * source.coneScale + source.coneOffset, 0.0f, 1.0f);
  return source.intensity * (window * cone * cone / square);
}

glm::vec3 openIrradiance(const LightSet& lights, const glm::vec3& at) {
  glm::vec3 sum(0), towards;
  float distance = 0;
  for (const auto* sources : {&lights.directional, &lights.wideDirectional})
    for (const auto& source : *sources) sum += source.irradiance;
  for (const auto* sources : {&lights.point, &lights.spot, &lights.wideLocal})
    for (const auto& source : *sources) sum += irradianceFrom(source, at, towards, distance);
  return sum;
}

}  // namespace acentric
