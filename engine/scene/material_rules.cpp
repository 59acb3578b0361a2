#include "engine/scene/material_rules.h"

namespace acentric {
namespace {

/// The effect plan calls for mirrors by the same limits.
bool isSmoothMetal(const Material& m) {
  return m.metallic >= 0.9f && m.roughness <= 0.1f && !m.metallicRoughnessTexture.used();
}

}  // namespace

std::vector<MaterialRules> materialRules(const Scene& scene, const EffectPlan& plan) {
  std::vector<MaterialRules> all;
  all.reserve(scene.materials.size());
  for (const Material& m : scene.materials) {
    MaterialRules rules;
    rules.unlit = plan.on(Effect::unlit) && m.unlit;
    rules.masked = plan.on(Effect::alphaTest) && m.alphaMode == AlphaMode::mask;
    rules.blended = plan.on(Effect::alphaBlend) && m.alphaMode == AlphaMode::blend;
    rules.transmissive = plan.on(Effect::transmission) && m.transmission > 0 && !rules.unlit;
    rules.mirror = plan.on(Effect::mirrorReflection) && isSmoothMetal(m) && !rules.unlit;
    all.push_back(rules);
  }
  return all;
}

DetailRules detailRules(const EffectPlan& plan) {
  return {plan.on(Effect::textures), plan.on(Effect::vertexColours), plan.on(Effect::normalMaps)};
}

}  // namespace acentric
