#include "engine/bake/ambient.h"
#include "engine/image/colour.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace acentric {
namespace {

/// Directions for the sky's light when no ray is traced.
constexpr int kFreeDirections = 24;
/// Directions flatter than this carry next to no light, and graze the surface.
constexpr float kFlattest = 1e-3f;

}  // namespace

glm::vec3 bouncedLightStandIn(const LightSet& lights, const Bounds& bounds) {
  if (lights.empty() || bounds.empty()) return glm::vec3(0);
  constexpr int kGrid = 5;
  constexpr float kShare = 0.08f;
  std::vector<glm::vec3> levels;
  for (int z = 0; z < kGrid; ++z)
    for (int y = 0; y < kGrid; ++y)
      for (int x = 0; x < kGrid; ++x) {
        // Cell centres of the box's middle half.
        const glm::vec3 share = 0.25f + 0.5f * (glm::vec3(x, y, z) + 0.5f) / float(kGrid);
        levels.push_back(openIrradiance(lights, bounds.min + share * bounds.size()));
      }
  const auto middle = levels.begin() + std::ptrdiff_t(levels.size() / 2);
  std::nth_element(levels.begin(), middle, levels.end(),
                   [](const glm::vec3& a, const glm::vec3& b) { return luminance(a) < luminance(b); });
  return *middle * (kShare * std::numbers::inv_pi_v<float>);
}

Ambient::Ambient(const RayScene& scene, const EffectPlan& plan, const LightSet& lights,
                 const BakeSettings& settings)
    : sky_(scene.scene().sky), radius_(float(settings.ambientRadius)) {
  hasSky_ = plan.on(Effect::sky) && sky_.present();
  const bool bounced = plan.on(Effect::diffuseInterreflection) && settings.ambientRays > 0;
  if (!hasSky_ && !bounced) standIn_ = bouncedLightStandIn(lights, scene.scene().bounds);
  const bool occluded = plan.on(Effect::ambientOcclusion) && settings.ambientRays > 0;
  const int count = occluded ? settings.ambientRays : kFreeDirections;
  for (int i = 0; i < count; ++i) {
    // A spiral of equal areas; with the opposites it covers the sphere, and of each pair one lies in any
    // hemisphere.
    const double z = (i + 0.5) / count;
    const double azimuth = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const double flat = std::sqrt(1 - z * z);
    directions_.emplace_back(flat * std::cos(azimuth), flat * std::sin(azimuth), z);
    above_.push_back(radianceFrom(directions_.back()));
    below_.push_back(radianceFrom(-directions_.back()));
  }
}

glm::vec3 Ambient::radianceFrom(const glm::vec3& direction) const {
  return hasSky_ ? sky_.radiance(direction) : standIn_;
}

float Ambient::visibility(float occluderDistance) const {
  const float x = std::clamp(occluderDistance / radius_, 0.0f, 1.0f);
  return x * x * (3 - 2 * x);
}

template <bool kOcclusion>
Ambient::Gathered Ambient::gather(const RayScene& scene, const Surface& surface, RayCounts& rays) const {
  glm::vec3 light(0);
  float open = 0, weights = 0;
  for (std::size_t i = 0; i < directions_.size(); ++i) {
    const float cosine = glm::dot(surface.normal, directions_[i]);
    const float weight = std::abs(cosine);
    const glm::vec3 direction = cosine < 0 ? -directions_[i] : directions_[i];
    // Below the real surface there is nothing to see, whatever the smoothed normal says.
    if (weight < kFlattest || glm::dot(surface.geometricNormal, direction) < kFlattest) continue;
    weights += weight;
    const glm::vec3& radiance = cosine < 0 ? below_[i] : above_[i];
    float visible = 1;
    if constexpr (kOcclusion) {
      if (radiance == glm::vec3(0)) continue;
      ++rays.ambient;
      visible = visibility(scene.occluderDistance({surface.rayOrigin, direction, 0, radius_}));
    }
    light += radiance * (weight * visible);
    open += weight * visible;
  }
  if (weights <= 0) return {};
  return {light / weights, open / weights};
}

template Ambient::Gathered Ambient::gather<true>(const RayScene&, const Surface&, RayCounts&) const;
template Ambient::Gathered Ambient::gather<false>(const RayScene&, const Surface&, RayCounts&) const;

}  // namespace acentric
