#include "engine/bake/direct_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace acentric {
namespace {

constexpr float kNoEnd = std::numeric_limits<float>::infinity();
constexpr float kShortOfLight = 1 - 1e-5f;

bool reaches(const Surface& surface, const glm::vec3& towards) {
  return glm::dot(surface.normal, towards) > 0 && glm::dot(surface.geometricNormal, towards) > 0;
}

template <bool kShadows>
glm::vec3 arriving(const RayScene& scene, const Surface& surface, const glm::vec3& irradiance,
                   const glm::vec3& towards, float distance, RayCounts& rays) {
  if (!reaches(surface, towards) || irradiance == glm::vec3(0)) return glm::vec3(0);
  glm::vec3 light = irradiance * glm::dot(surface.normal, towards);
  if constexpr (kShadows) {
    ++rays.shadow;
    light *= scene.transmittance({surface.rayOrigin, towards, 0, distance});
  }
  return light;
}

/// Light as seen from one point: a cone of directions, even within.
struct Cone {
  glm::vec3 axis;
  float cosine = 1;  ///< of its half angle
  /// Of a sphere, metres; infinite for a light that has no place.
  float distance = kNoEnd, radius = 0;

  /// Metres to the light's surface in a direction of this cosine to the axis.
  float reach(float along) const {
    if (distance == kNoEnd) return kNoEnd;
    const float across = distance * distance * (1 - along * along);
    return distance * along - std::sqrt(std::max(0.0f, radius * radius - across));
  }
};

/// Share of a cone's light that arrives, weighed by cosine.
glm::vec3 shareOf(const RayScene& scene, const Surface& surface, const PositionSamples::Points& points,
                  int count, const Cone& cone, RayCounts& rays) {
  const Across across(cone.axis);
  glm::vec3 sum(0);
  float weights = 0;
  for (std::uint32_t k = 0; k < std::uint32_t(count); ++k) {
    const glm::vec2 u = points.at(k);
    const float along = 1 - u.x * (1 - cone.cosine), angle = 2 * std::numbers::pi_v<float> * u.y;
    const float aside = std::sqrt(std::max(0.0f, 1 - along * along));
    const glm::vec3 towards = cone.axis * along + across.at(aside * std::cos(angle), aside * std::sin(angle));
    const float cosine = std::max(0.0f, glm::dot(surface.normal, towards));
    weights += cosine;
    if (!reaches(surface, towards)) continue;
    ++rays.softShadow;
    sum += cosine * scene.transmittance({surface.rayOrigin, towards, 0, cone.reach(along) * kShortOfLight});
  }
  return weights > 0 ? sum / weights : glm::vec3(0);
}

}  // namespace

float sampleCell(const Bounds& bounds) {
  const glm::vec3 size = bounds.size();
  const float largest = std::max(size.x, std::max(size.y, size.z));
  return largest > 0 ? std::exp2(std::round(std::log2(largest)) - 13) : 1;
}

DirectLights::DirectLights(const RayScene& scene, const EffectPlan& plan, const BakeSettings& settings)
    : scene_(&scene),
      set_(lightSet(scene.scene(), plan)),
      area_(plan.on(Effect::areaLights) && !scene.areaLights().empty() ? &scene.areaLights() : nullptr),
      samples_(sampleCell(scene.scene().bounds)),
      shadowRays_(settings.shadowRays),
      hardShadows_(plan.on(Effect::hardShadows)),
      softShadows_(plan.on(Effect::softShadows)) {}

template <bool kShadows>
glm::vec3 DirectLights::small(const Surface& surface, RayCounts& rays) const {
  glm::vec3 sum(0);
  for (const auto& source : set_.directional)
    sum += arriving<kShadows>(*scene_, surface, source.irradiance, source.towards, kNoEnd, rays);
  for (const auto* sources : {&set_.point, &set_.spot})
    for (const auto& source : *sources) {
      glm::vec3 towards;
      float distance = 0;
      const glm::vec3 irradiance = irradianceFrom(source, surface.rayOrigin, towards, distance);
      sum += arriving<kShadows>(*scene_, surface, irradiance, towards, distance * kShortOfLight, rays);
    }
  return sum;
}

template <bool kShadows>
glm::vec3 DirectLights::wide(const Surface& surface, RayCounts& rays) const {
  if constexpr (!kShadows) {
    return area_ == nullptr ? glm::vec3(0)
                            : area_->irradiance(surface);  // lamps with a size count as small ones then
  } else {
    glm::vec3 sum(0);
    std::uint32_t stream = 1;
    // A lamp above the horizon sends what its middle does; its size only softens shadows.
    for (const auto& source : set_.wideDirectional) {
      const auto points = samples_.at(surface.position, stream++);
      const float cosine = glm::dot(surface.normal, source.towards);
      if (cosine > 0)
        sum += source.irradiance * cosine *
               shareOf(*scene_, surface, points, shadowRays_, {source.towards, source.cosine}, rays);
    }
    for (const auto& source : set_.wideLocal) {
      const auto points = samples_.at(surface.position, stream++);
      Cone cone;
      const glm::vec3 irradiance = irradianceFrom(source, surface.rayOrigin, cone.axis, cone.distance);
      const float cosine = glm::dot(surface.normal, cone.axis);
      if (cosine <= 0 || irradiance == glm::vec3(0)) continue;
      cone.radius = std::min(source.radius, cone.distance);  // within the lamp: half of all directions
      const float sine = cone.radius / cone.distance;
      cone.cosine = std::sqrt(1 - sine * sine);
      sum += irradiance * cosine * shareOf(*scene_, surface, points, shadowRays_, cone, rays);
    }
    if (area_ != nullptr) sum += area_->irradiance(*scene_, surface, samples_, shadowRays_, rays);
    return sum;
  }
}

glm::vec3 DirectLights::at(const Surface& surface, RayCounts& rays) const {
  const glm::vec3 small = hardShadows_ ? this->small<true>(surface, rays) : this->small<false>(surface, rays);
  return small + (softShadows_ ? wide<true>(surface, rays) : wide<false>(surface, rays));
}

template glm::vec3 DirectLights::small<true>(const Surface&, RayCounts&) const;
template glm::vec3 DirectLights::small<false>(const Surface&, RayCounts&) const;
template glm::vec3 DirectLights::wide<true>(const Surface&, RayCounts&) const;
template glm::vec3 DirectLights::wide<false>(const Surface&, RayCounts&) const;

}  // namespace acentric
