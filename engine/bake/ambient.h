#pragma once
/// Light from all around: the sky, or where there is none a stand-in for light that bounced. Gathered along
/// fixed directions in the world, the same for every point, so neighbouring cameras, the surfaces' own light
/// and the reference agree to the last bit instead of differing by noise.

#include <glm/glm.hpp>
#include <vector>

#include "engine/bake/bake_settings.h"
#include "engine/bake/light_set.h"
#include "engine/bake/ray_scene.h"
#include "engine/bake/surface.h"

namespace acentric {

class Ambient {
 public:
  Ambient(const RayScene& scene, const EffectPlan& plan, const LightSet& lights,
          const BakeSettings& settings);
  Ambient(const RayScene& scene, const LightSet& lights, const BakeSettings& settings)
      : Ambient(scene, scene.plan(), lights, settings) {}

  struct Gathered {
    glm::vec3 radiance{0};  ///< cosine-weighted mean, i.e. what a white Lambert surface sends back
    float open = 1;         ///< share that no occluder takes
  };
  /// `kOcclusion`: one ray per direction in the hemisphere; else none.
  template <bool kOcclusion>
  Gathered gather(const RayScene& scene, const Surface& surface, RayCounts& rays) const;

  /// Is it the same from every direction?
  bool even() const { return !hasSky_; }
  /// Arriving from one direction, nothing in between.
  glm::vec3 radianceFrom(const glm::vec3& direction) const;
  /// Share of light that passes an occluder at this distance: 0 at 0 m, 1 from the radius on, smooth between.
  float visibility(float occluderDistance) const;

 private:
  Sky sky_;
  bool hasSky_ = false;
  glm::vec3 standIn_{0};  ///< constant radiance where there is no sky
  float radius_ = 1;
  std::vector<glm::vec3> directions_;  ///< upper half; the lower half is their opposites
  std::vector<glm::vec3> above_;       ///< radiance from directions_[i]
  std::vector<glm::vec3> below_;       ///< radiance from -directions_[i]
};

/// Radiance that stands in for bounced light where a scene has no sky: 8 % of what a white surface sends back
/// in the typical light (the median of a fixed grid in the middle of the scene).
glm::vec3 bouncedLightStandIn(const LightSet& lights, const Bounds& bounds);

}  // namespace acentric
