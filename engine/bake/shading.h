#pragma once
/// The one shading routine, used by captures, surface light and the reference picture alike. It is composed
/// at compile time from the effect plan: `Shader` picks the instantiation once, and what is off is not in it.
///
/// Switches of an instantiation (144 in all): lights without size {none, unshadowed, shadowed} x lights with
/// one and surfaces that glow {the same} x light from all around {free, occluded, bounced} x surface detail
/// (textures, vertex colours, normal maps together: each is one test of a flag beside a texture read) x
/// special materials (mirrors, glass, blending: a flag per material, since even where they exist few hits are
/// on them).
///
/// Radiance leaving a surface = baseColour * light + emission. `light` does not depend on the viewer except
/// on metals, mirrors and glass.

#include <glm/glm.hpp>
#include <stop_token>
#include <vector>

#include "engine/bake/ambient.h"
#include "engine/bake/direct_light.h"
#include "engine/bake/gathered_light.h"
#include "engine/bake/ray_scene.h"
#include "engine/bake/surface.h"
#include "engine/image/capture.h"
#include "engine/scene/material_rules.h"

namespace acentric {

struct Shaded {
  glm::vec3 baseColour{1};
  glm::vec3 light{0};
  glm::vec3 emission{0};
  float alpha = 1;  ///< 1 = opaque; else what lies behind shows by 1 - alpha
  bool dependsOnViewer = false;
  glm::vec3 radiance() const { return baseColour * light + emission; }
};

/// A metal this faint looks the same from everywhere.
inline constexpr float kFaintlyMetallic = 0.05f;
/// A hit this opaque hides what is behind it; one this clear is not there at all.
inline constexpr float kOpaqueAlpha = 0.999f;
inline constexpr float kInvisibleAlpha = 1.0f / 512;
/// A ray ends after so many that are neither.
inline constexpr int kMaxBlendedLayers = 32;

/// Where to go on behind a hit: far enough not to meet it again, and coinciding surfaces count once.
float justBehind(float distance);

class Shader {
 public:
  /// A stop ends the gathering of light soon; what is shaded after it means nothing.
  Shader(const RayScene& scene, const BakeSettings& settings, std::stop_token stop = {});
  /// With fewer effects than the scene was built for, and with gathered light of one's own (null where the
  /// plan gathers none).
  Shader(const RayScene& scene, const EffectPlan& plan, const BakeSettings& settings,
         std::shared_ptr<const GatheredLight> gathered, std::stop_token stop = {});

  /// `toViewer` is unit; it decides the side. `seenInMirror`: mirrors then show the sky or ambient light
  /// only. `area`: what textures are averaged over (texture_area.h).
  Shaded shade(const Hit& hit, const glm::vec3& toViewer, RayCounts& rays, bool seenInMirror = false,
               const std::optional<TextureArea>& area = {}) const {
    return kernel_(*this, hit, toViewer, seenInMirror, area ? &*area : nullptr, rays);
  }
  const DetailRules& detail() const { return detail_; }
  /// By material.
  const std::vector<MaterialRules>& rules() const { return rules_; }
  /// What is seen where a ray hits nothing; all zero (black) where the plan has none.
  Sky sky() const { return scene_->plan().on(Effect::sky) ? scene_->scene().sky : Sky{}; }
  glm::vec3 background(const glm::vec3& direction) const { return sky().radiance(direction); }

  /// A surface on a ray's way, or the sky that ends it.
  struct Layer {
    Hit hit;  ///< not found: the sky
    glm::vec3 radiance{0};
    float alpha = 1;  ///< 1: it ends the ray
  };
  struct Seen {
    glm::vec3 radiance{0};
    float passing = 1;  ///< of what is behind
    Hit opaque;         ///< what ends the ray; not found: the sky
    /// What is behind all that was added.
    void add(const Layer& layer);
  };
  /// What a ray sees: blended layers composed front to back in linear light. Each ray is counted in
  /// `counter`.
  Seen seenAlong(const Ray& ray, std::uint64_t RayCounts::*counter, RayCounts& rays,
                 bool seenInMirror = false) const;

  /// What a plane mirror is seen to show: light that arrives by the mirrored ray.
  struct Mirrored {
    Shaded surface;
    std::vector<Layer> shown;  ///< what that light comes from, nearest first, each as the mirror shows it
  };
  /// A hit on a mirror of FlatMirrors; without a footprint the same radiance as shade() gives.
  Mirrored shadeFlatMirror(const Hit& hit, const glm::vec3& toViewer, RayCounts& rays,
                           const SampleFootprint& footprint = {}) const;
  /// The same mirror where `light` arrives, whatever it is.
  Shaded flatMirrorUnder(const glm::vec3& light, const Hit& hit, const glm::vec3& toViewer) const;

  /// Where nothing but its material decides how a surface looks (no light from anywhere in particular, no
  /// detail, nothing clear or mirrored): the radiance by mesh, as captures store it. Else empty.
  const std::vector<HalfColour>& evenColours() const { return evenColours_; }

  const RayScene& scene() const { return *scene_; }

  enum class DirectLight : std::uint8_t { none, unshadowed, shadowed };
  /// Light from all around: the same everywhere, as if nothing were in the way, less what occluders take, or
  /// bounced between surfaces.
  enum class Around : std::uint8_t { even, free, occluded, bounced };
  struct Switches {
    DirectLight direct = DirectLight::none;  ///< of lights without size
    DirectLight wide = DirectLight::none;    ///< of lights with one, and of surfaces that glow
    Around around = Around::even;
    bool detail = false;
    bool special = false;
  };
  const Switches& switches() const { return switches_; }

 private:
  /// Calls `visit` with each layer of a ray, nearest first.
  template <class Visit>
  void eachLayer(const Ray& ray, std::uint64_t RayCounts::*counter, RayCounts& rays, bool seenInMirror,
                 const SampleFootprint& footprint, const Visit& visit) const;
  using Kernel = Shaded (*)(const Shader&, const Hit&, const glm::vec3&, bool, const TextureArea*,
                            RayCounts&);
  friend struct ShadingKernels;
  Surface flatMirrorAt(const Hit& hit, const glm::vec3& toViewer) const;

  const RayScene* scene_;
  std::vector<MaterialRules> rules_;
  DetailRules detail_;
  bool emission_ = false;
  DirectLights lights_;
  Ambient ambient_;
  std::shared_ptr<const GatheredLight> gathered_;
  std::stop_token stop_;
  Switches switches_;
  Kernel kernel_;
  std::vector<HalfColour> evenColours_;
};

}  // namespace acentric
