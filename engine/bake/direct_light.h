#pragma once
/// Light that comes straight from its source: lamps and suns with and without size, and surfaces that glow.

#include "engine/bake/area_lights.h"
#include "engine/bake/bake_settings.h"
#include "engine/bake/light_set.h"
#include "engine/bake/position_samples.h"
#include "engine/bake/ray_scene.h"
#include "engine/bake/surface.h"

namespace acentric {

/// Side of the cubes that share a scramble of shadow samples: some thousand times the rounding of positions,
/// so that two cameras hardly ever differ, and still about what one sample of a capture covers.
float sampleCell(const Bounds& bounds);

class DirectLights {
 public:
  DirectLights(const RayScene& scene, const EffectPlan& plan, const BakeSettings& settings);
  DirectLights(const RayScene& scene, const BakeSettings& settings)
      : DirectLights(scene, scene.plan(), settings) {}

  const LightSet& set() const { return set_; }
  bool hasSmall() const { return set_.hasSmall(); }
  bool hasWide() const { return set_.hasWide() || area_ != nullptr; }

  /// Irradiance of the lights without size.
  template <bool kShadows>
  glm::vec3 small(const Surface& surface, RayCounts& rays) const;
  /// Irradiance of the lights with a size, and of the surfaces that glow.
  template <bool kShadows>
  glm::vec3 wide(const Surface& surface, RayCounts& rays) const;

  /// Irradiance of all of them, with the shadows that the plan has on.
  glm::vec3 at(const Surface& surface, RayCounts& rays) const;

 private:
  const RayScene* scene_;
  LightSet set_;
  const AreaLights* area_;  ///< null where nothing that glows is a light
  PositionSamples samples_;
  int shadowRays_;
  bool hardShadows_, softShadows_;
};

}  // namespace acentric
