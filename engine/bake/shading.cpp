#include "engine/bake/shading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/bake/surface.h"
#include "engine/scene/surface_alpha.h"

namespace acentric {

float justBehind(float distance) { return distance * (1 + 1e-6f) + 1e-9f; }

/// The instantiations, and the table that finds one.
struct ShadingKernels {
  using DirectLight = Shader::DirectLight;
  using Around = Shader::Around;

  template <Around kAround>
  static GatheredLight::Gathered around(const Shader& shader, const Hit& hit, const glm::vec3& toViewer,
                                        const Surface& surface, RayCounts& rays) {
    if constexpr (kAround == Around::even) {
      return {shader.ambient_.radianceFrom(surface.normal), 1};
    } else if constexpr (kAround == Around::free) {
      const Ambient::Gathered ambient = shader.ambient_.gather<false>(*shader.scene_, surface, rays);
      return {ambient.radiance, ambient.open};
    } else {
      return shader.gathered_->at(hit, glm::dot(hit.geometricNormal(), toViewer) < 0, rays, shader.stop_);
    }
  }

  /// What lies in one direction, as far as light from all around tells.
  template <Around kAround>
  static glm::vec3 inMirror(const Shader& shader, const glm::vec3& direction,
                            const GatheredLight::Gathered& ambient) {
    glm::vec3 seen = shader.ambient_.radianceFrom(direction) * ambient.open;
    if constexpr (kAround == Around::bounced) seen += ambient.radiance * (1 - ambient.open);
    return seen;
  }

  /// A surface whose look depends on its material alone.
  static Shaded evenly(const Shader& shader, std::size_t material, const MaterialRules& rules) {
    const Material& look = shader.scene_->scene().materials[material];
    Shaded out;
    out.baseColour = glm::vec3(look.baseColour);
    if (shader.emission_ && !rules.unlit) out.emission = look.emissive;
    out.light = rules.unlit ? glm::vec3(1) : shader.ambient_.radianceFrom({0, 0, 1});
    return out;
  }

  template <DirectLight kSmall, DirectLight kWide, Around kAround, bool kDetail, bool kSpecial>
  static Shaded shade(const Shader& shader, const Hit& hit, const glm::vec3& toViewer, bool seenInMirror,
                      const TextureArea* area, RayCounts& rays) {
    const RayScene& scene = *shader.scene_;
    const auto material = std::size_t(scene.scene().meshOf(hit.mesh).material);
    const MaterialRules& rules = shader.rules_[material];
    if constexpr (kSmall == DirectLight::none && kWide == DirectLight::none && kAround == Around::even &&
                  !kDetail && !kSpecial)
      return evenly(shader, material, rules);
    const Surface surface = surfaceAt<kDetail>(scene.scene(), hit, toViewer, shader.detail_,
                                               shader.emission_ && !rules.unlit, area);

    Shaded out;
    out.baseColour = glm::vec3(surface.baseColour);
    out.emission = surface.emission;
    if constexpr (kSpecial)
      if (rules.blended) out.alpha = std::clamp(surface.baseColour.a, 0.0f, 1.0f);
    if constexpr (kSpecial)
      if (rules.clear()) ++rays.through;
    if (rules.unlit) {
      out.light = glm::vec3(1);
      return out;
    }
    const glm::vec3 mirrored = glm::reflect(-toViewer, surface.normal);
    if constexpr (kSpecial) {
      if (out.alpha < kInvisibleAlpha) return out;
      if (rules.mirror && !seenInMirror && glm::dot(mirrored, surface.geometricNormal) > 0) {
        out.light = shader.seenAlong({surface.rayOrigin, mirrored}, &RayCounts::mirror, rays, true).radiance;
        out.dependsOnViewer = true;
        return out;
      }
    }

    const GatheredLight::Gathered ambient = around<kAround>(shader, hit, toViewer, surface, rays);
    out.light = ambient.radiance;
    glm::vec3 direct(0);
    if constexpr (kSmall != DirectLight::none)
      direct += shader.lights_.template small<kSmall == DirectLight::shadowed>(surface, rays);
    if constexpr (kWide != DirectLight::none)
      direct += shader.lights_.template wide<kWide == DirectLight::shadowed>(surface, rays);
    out.light += direct * std::numbers::inv_pi_v<float>;
    // Metals have no diffuse colour of their own; without traced reflections half stays, and the rest is what
    // lies in the mirrored direction, the blurrier the rougher.
    const float metal = std::clamp(surface.metallic, 0.0f, 1.0f);
    out.dependsOnViewer = metal > kFaintlyMetallic;
    if (metal > 0) {
      const float rough = std::clamp(surface.roughness, 0.0f, 1.0f);
      const glm::vec3 seen = glm::mix(inMirror<kAround>(shader, mirrored, ambient), ambient.radiance, rough);
      out.light = out.light * (1 - 0.5f * metal) + seen * (0.5f * metal);
    }
    if constexpr (kSpecial) {
      if (rules.transmissive) {
        const GlassAlpha glass = glassAlpha(scene.scene().materials[material].transmission, out.baseColour,
                                            glm::dot(surface.normal, toViewer));
        const glm::vec3 film = inMirror<kAround>(shader, mirrored, ambient);
        out.light = (out.light * glass.body + film * glass.film) / glass.alpha();
        out.alpha *= glass.alpha();
        out.dependsOnViewer = true;
      }
    }
    return out;
  }

  static bool isEven(const Shader::Switches& s) {
    return s.direct == DirectLight::none && s.wide == DirectLight::none && s.around == Around::even &&
           !s.detail && !s.special;
  }

  template <std::size_t kIndex>
  static constexpr Shader::Kernel at() {
    return &shade<static_cast<DirectLight>(kIndex / 48), static_cast<DirectLight>(kIndex / 16 % 3),
                  static_cast<Around>(kIndex / 4 % 4), (kIndex & 2) != 0, (kIndex & 1) != 0>;
  }
  template <std::size_t... kIndices>
  static constexpr auto table(std::index_sequence<kIndices...>) {
    return std::array<Shader::Kernel, sizeof...(kIndices)>{at<kIndices>()...};
  }
  static Shader::Kernel find(const Shader::Switches& s) {
    static constexpr auto kTable = table(std::make_index_sequence<144>{});
    return kTable[std::size_t(s.direct) * 48 + std::size_t(s.wide) * 16 + std::size_t(s.around) * 4 +
                  (s.detail ? 2u : 0u) + (s.special ? 1u : 0u)];
  }
};

Shader::Shader(const RayScene& scene, const BakeSettings& settings, std::stop_token stop)
    : Shader(scene, scene.plan(), settings,
             gathersLight(scene.plan(), settings) ? scene.gatheredLight(settings) : nullptr,
             std::move(stop)) {}

Shader::Shader(const RayScene& scene, const EffectPlan& plan, const BakeSettings& settings,
               std::shared_ptr<const GatheredLight> gathered, std::stop_token stop)
    : scene_(&scene),
      rules_(materialRules(scene.scene(), plan)),
      detail_(detailRules(plan)),
      emission_(plan.on(Effect::emission)),
      lights_(scene, plan, settings),
      ambient_(scene, plan, lights_.set(), settings),
      gathered_(std::move(gathered)),
      stop_(std::move(stop)) {
  const auto use = [](bool any, bool shadows) {
    return !any ? DirectLight::none : shadows ? DirectLight::shadowed : DirectLight::unshadowed;
  };
  switches_.direct = use(lights_.hasSmall(), plan.on(Effect::hardShadows));
  switches_.wide = use(lights_.hasWide(), plan.on(Effect::softShadows));
  if (!ambient_.even()) switches_.around = Around::free;
  if (gathersLight(plan, settings)) {
    switches_.around = plan.on(Effect::diffuseInterreflection) ? Around::bounced : Around::occluded;
  }
  switches_.detail = detail_.any();
  switches_.special =
      std::any_of(rules_.begin(), rules_.end(), [](const MaterialRules& r) { return r.mirror || r.clear(); });
  kernel_ = ShadingKernels::find(switches_);
  if (ShadingKernels::isEven(switches_))
    for (std::uint32_t placed = 0; placed < scene.scene().placedCount(); ++placed) {
      const auto material = std::size_t(scene.scene().meshOf(placed).material);
      const Shaded look = ShadingKernels::evenly(*this, material, rules_[material]);
      evenColours_.push_back(packColour({look.radiance(), 1}));
    }
}

namespace {
Shaded mirrorUnder(const glm::vec3& light, const Surface& surface) {
  return {glm::vec3(surface.baseColour), light, surface.emission};
}
}  // namespace

Surface Shader::flatMirrorAt(const Hit& hit, const glm::vec3& toViewer) const {
  const auto surfaceOf = detail_.any() ? surfaceAt<true> : surfaceAt<false>;
  return surfaceOf(scene_->scene(), hit, toViewer, detail_, emission_, nullptr);
}

Shaded Shader::flatMirrorUnder(const glm::vec3& light, const Hit& hit, const glm::vec3& toViewer) const {
  return mirrorUnder(light, flatMirrorAt(hit, toViewer));
}

Shader::Mirrored Shader::shadeFlatMirror(const Hit& hit, const glm::vec3& toViewer, RayCounts& rays,
                                         const SampleFootprint& footprint) const {
  const Surface surface = flatMirrorAt(hit, toViewer);
  const glm::vec3 mirrored = glm::reflect(-toViewer, surface.geometricNormal);
  Mirrored out;
  Seen seen;
  eachLayer({surface.rayOrigin, mirrored}, &RayCounts::mirror, rays, true,
            footprint.mirrored(surface.geometricNormal, hit.distance), [&](const Layer& layer) {
              seen.add(layer);
              out.shown.push_back({layer.hit, mirrorUnder(layer.radiance, surface).radiance(), layer.alpha});
            });
  out.surface = mirrorUnder(seen.radiance, surface);
  return out;
}

void Shader::Seen::add(const Layer& layer) {
  radiance += (passing * layer.alpha) * layer.radiance;
  passing *= 1 - layer.alpha;
  if (layer.alpha >= 1) opaque = layer.hit;
}

template <class Visit>
void Shader::eachLayer(const Ray& ray, std::uint64_t RayCounts::*counter, RayCounts& rays, bool seenInMirror,
                       const SampleFootprint& footprint, const Visit& visit) const {
  Ray rest = ray;
  for (int layer = 0; layer < kMaxBlendedLayers; ++layer) {
    ++(rays.*counter);
    const Hit hit = scene_->trace(rest);
    if (!hit.found()) return visit(Layer{hit, background(ray.direction)});
    const Shaded shaded =
        shade(hit, -ray.direction, rays, seenInMirror, footprint.on(scene_->scene(), hit, ray.direction));
    if (shaded.alpha >= kOpaqueAlpha) return visit(Layer{hit, shaded.radiance()});
    if (shaded.alpha >= kInvisibleAlpha) visit(Layer{hit, shaded.radiance(), shaded.alpha});
    rest.nearest = justBehind(hit.distance);
  }
}

Shader::Seen Shader::seenAlong(const Ray& ray, std::uint64_t RayCounts::*counter, RayCounts& rays,
                               bool seenInMirror) const {
  Seen seen;
  eachLayer(ray, counter, rays, seenInMirror, {}, [&](const Layer& layer) { seen.add(layer); });
  return seen;
}

}  // namespace acentric
