#include "engine/scene/effect_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "engine/scene/emitters.h"

namespace acentric {
namespace {

struct EffectNames {
  const char* name;
  const char* label;
};

constexpr std::array<EffectNames, kEffectCount> kNames{{
    {"textures", "Textures"},
    {"vertexColours", "Vertex colours"},
    {"alphaTest", "Alpha test"},
    {"alphaBlend", "Alpha blend"},
    {"emission", "Emission"},
    {"directionalLights", "Directional lights"},
    {"pointLights", "Point lights"},
    {"spotLights", "Spot lights"},
    {"areaLights", "Glowing surfaces as lights"},
    {"sky", "Sky light"},
    {"hardShadows", "Hard shadows"},
    {"softShadows", "Soft shadows"},
    {"ambientOcclusion", "Ambient occlusion"},
    {"diffuseInterreflection", "Diffuse interreflection"},
    {"mirrorReflection", "Mirror reflection"},
    {"transmission", "Transmission"},
    {"normalMaps", "Normal maps"},
    {"unlit", "Unlit materials"},
}};

/// "3 materials with textures: Floor, Wall, frame" (the first three by name).
std::string listed(const std::vector<std::string>& names, const char* one, const char* many,
                   const char* what) {
  std::string text =
      fmt::format("{} {}{}{}", names.size(), names.size() == 1 ? one : many, *what ? " " : "", what);
  for (std::size_t i = 0; i < names.size() && i < 3; ++i) text += (i ? ", " : ": ") + names[i];
  if (names.size() > 3) text += ", ...";
  return text;
}

class Planner {
 public:
  Planner(const Scene& scene, const EffectOverrides& overrides) : scene_(scene), overrides_(overrides) {
    std::vector<bool> used(scene.materials.size());
    for (const auto* meshes : {&scene.meshes, &scene.prototypes})
      for (const Mesh& mesh : *meshes)
        if (!mesh.triangles.empty()) used[std::size_t(mesh.material)] = true;
    for (std::size_t m = 0; m < used.size(); ++m)
      if (used[m]) materials_.push_back(int(m));
    allUnlit_ = !materials_.empty();
    for (const int m : materials_) allUnlit_ = allUnlit_ && material(m).unlit;
  }

  EffectPlan plan() {
    planMaterials();
    planLights();
    planLightTransport();
    return std::move(plan_);
  }

 private:
  const Material& material(int index) const { return scene_.materials[std::size_t(index)]; }

  static std::string nameOr(const std::string& name, const char* kind, std::size_t number) {
    return name.empty() ? fmt::format("{} {}", kind, number + 1) : name;
  }

  void set(Effect effect, bool calledFor, std::string reason) {
    plan_[effect].calledFor = plan_[effect].on = calledFor;
    plan_[effect].reason = std::move(reason);
  }

  void byMaterials(Effect effect, const char* what, const char* none,
                   const std::function<bool(const Material&)>& has) {
    std::vector<std::string> names;
    for (const int m : materials_)
      if (has(material(m))) names.push_back(nameOr(material(m).name, "material", std::size_t(m)));
    set(effect, !names.empty(), names.empty() ? none : listed(names, "material", "materials", what));
  }

  void planMaterials() {
    byMaterials(Effect::textures, "with textures", "no used material has a texture", [](const Material& m) {
      return m.baseColourTexture.used() ||
             (!m.unlit && (m.emissiveTexture.used() || m.metallicRoughnessTexture.used()));
    });
    byMaterials(Effect::alphaTest, "with an alpha mask", "no used material has an alpha mask",
                [](const Material& m) { return m.alphaMode == AlphaMode::mask; });
    byMaterials(Effect::alphaBlend, "with alpha blending", "no used material blends by alpha",
                [](const Material& m) { return m.alphaMode == AlphaMode::blend; });
    byMaterials(Effect::emission, "that emit light", "no used material emits light",
                [](const Material& m) { return !m.unlit && m.emissive != glm::vec3(0); });
    byMaterials(Effect::mirrorReflection, "that are smooth metal", "no used material is smooth metal",
                [](const Material& m) {
                  return !m.unlit && m.metallic >= 0.9f && m.roughness <= 0.1f &&
                         !m.metallicRoughnessTexture.used();
                });
    byMaterials(Effect::transmission, "that let light through", "no used material lets light through",
                [](const Material& m) { return !m.unlit && m.transmission > 0; });
    byMaterials(Effect::normalMaps, "with normal maps", "no used material has a normal map",
                [](const Material& m) { return !m.unlit && m.normalTexture.used() && m.normalScale != 0; });
    byMaterials(Effect::unlit, "without lighting", "every used material is lit",
                [](const Material& m) { return m.unlit; });

    std::vector<std::string> coloured;
    const auto tinted = [](const glm::u8vec4& c) { return c != glm::u8vec4(255); };
    for (const auto* meshes : {&scene_.meshes, &scene_.prototypes})
      for (const Mesh& mesh : *meshes)
        if (!mesh.triangles.empty() && std::any_of(mesh.colours.begin(), mesh.colours.end(), tinted))
          coloured.push_back(nameOr(mesh.name, "mesh", std::size_t(&mesh - meshes->data())));
    set(Effect::vertexColours, !coloured.empty(),
        coloured.empty() ? "no mesh has vertex colours other than white"
                         : listed(coloured, "mesh", "meshes", "with vertex colours"));
  }

  std::vector<std::string> lightsWhere(const std::function<bool(const Light&)>& wanted) const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
      const Light& light = scene_.lights[i];
      if (light.intensity > 0 && light.colour != glm::vec3(0) && wanted(light))
        names.push_back(nameOr(light.name, "light", i));
    }
    return names;
  }

  void planAreaLights() {
    const std::vector<std::uint8_t> lighting = lightingMeshes(scene_);
    std::vector<bool> materialLights(scene_.materials.size());
    for (std::size_t m = 0; m < lighting.size(); ++m)
      if (lighting[m] != 0) materialLights[std::size_t(scene_.meshes[m].material)] = true;
    std::vector<std::string> names;
    for (const int m : materials_)
      if (materialLights[std::size_t(m)])
        names.push_back(nameOr(material(m).name, "material", std::size_t(m)));
    if (allUnlit_)
      set(Effect::areaLights, false, "every used material is unlit");
    else if (!names.empty())
      set(Effect::areaLights, true,
          listed(names, "material", "materials", "bright and large enough to light others"));
    else
      set(Effect::areaLights, false,
          plan_[Effect::emission].calledFor ? "what glows is too faint or small to light others"
                                            : "no used material emits light");
  }

  void planLights() {
    struct Kind {
      Effect effect;
      LightKind kind;
      const char *one, *many;
    };
    for (const Kind& k :
         {Kind{Effect::directionalLights, LightKind::directional, "directional light", "directional lights"},
          Kind{Effect::pointLights, LightKind::point, "point light", "point lights"},
          Kind{Effect::spotLights, LightKind::spot, "spot light", "spot lights"}}) {
      const std::vector<std::string> names =
          lightsWhere([&](const Light& light) { return light.kind == k.kind; });
      if (allUnlit_)
        set(k.effect, false, "every used material is unlit");
      else
        set(k.effect, !names.empty(),
            names.empty() ? fmt::format("no {}", k.one) : listed(names, k.one, k.many, ""));
    }
    planAreaLights();
    if (allUnlit_)
      set(Effect::sky, false, "every used material is unlit");
    else
      set(Effect::sky, scene_.sky.present(),
          scene_.sky.present() ? "the scene has a sky" : "the scene has no sky");
  }

  void planLightTransport() {
    const bool sun = plan_[Effect::directionalLights].calledFor;
    const bool local = plan_[Effect::pointLights].calledFor || plan_[Effect::spotLights].calledFor;
    const bool area = plan_[Effect::areaLights].calledFor;
    const bool sky = plan_[Effect::sky].calledFor;
    const auto wide = [](const Light& light) {
      return (light.kind == LightKind::directional ? light.angularRadius : light.radius) > 0;
    };
    const std::vector<std::string> large = lightsWhere(wide);
    const bool small = !lightsWhere([&](const Light& light) { return !wide(light); }).empty();
    const char* const noLight = allUnlit_ ? "every used material is unlit" : "the scene has no light";
    if ((sun || local) && small)
      set(Effect::hardShadows, true, "lights without size cast hard shadows");
    else
      set(Effect::hardShadows, false, allUnlit_ ? noLight : "no light without size");
    if ((sun || local) && !large.empty())
      set(Effect::softShadows, true, listed(large, "light", "lights", "with a size"));
    else if (area)
      set(Effect::softShadows, true, "surfaces that glow cast soft shadows");
    else
      set(Effect::softShadows, false, allUnlit_ ? noLight : "lights have no size");
    const bool lit = sun || local || area || sky;
    if (!lit)
      set(Effect::diffuseInterreflection, false, noLight);
    else if (sun || sky)
      set(Effect::diffuseInterreflection, false, "sun and sky reach most surfaces themselves");
    else
      set(Effect::diffuseInterreflection, true,
          "lamps alone leave what they do not shine on to bounced light");
    const auto overridden = overrides_.find(Effect::diffuseInterreflection);
    const bool bounced = lit && (overridden == overrides_.end() ? plan_.on(Effect::diffuseInterreflection)
                                                                : overridden->second);
    if (bounced)
      set(Effect::ambientOcclusion, false, "bounced light takes its place");
    else if (sky)
      set(Effect::ambientOcclusion, true, "light from the sky reaches corners less");
    else if ((local || area) && !sun)
      set(Effect::ambientOcclusion, true, "stands in for bounced light: the scene has only local lights");
    else
      set(Effect::ambientOcclusion, false, sun ? "no light from the sky" : noLight);
  }

  const Scene& scene_;
  const EffectOverrides& overrides_;
  std::vector<int> materials_;  ///< those with triangles
  bool allUnlit_ = false;
  EffectPlan plan_;
};

}  // namespace

const char* nameOf(Effect effect) { return kNames[std::size_t(effect)].name; }
const char* labelOf(Effect effect) { return kNames[std::size_t(effect)].label; }

void EffectPlan::addTo(Hasher& hasher) const {
  for (const EffectState& state : effects) hasher.value(state.on);
}

EffectPlan planEffects(const Scene& scene, const EffectOverrides& overrides) {
  EffectPlan plan = Planner(scene, overrides).plan();
  for (const auto& [effect, on] : overrides) {
    EffectState& state = plan[effect];
    state.on = on;
    state.overridden = true;
  }
  return plan;
}

}  // namespace acentric
