#include "engine/export/bundle_materials.h"

namespace acentric {

Material localMaterial(const Material& material, const EffectPlan& plan) {
  Material out = material;
  out.metallicRoughnessTexture = out.normalTexture = {};
  out.unlit = material.unlit && plan.on(Effect::unlit);
  if (!plan.on(Effect::textures)) out.baseColourTexture = out.emissiveTexture = {};
  if (!plan.on(Effect::emission)) out.emissive = glm::vec3(0);
  if (out.emissive == glm::vec3(0)) out.emissiveTexture = {};
  if (!plan.on(Effect::transmission)) out.transmission = 0;
  const bool cut = material.alphaMode == AlphaMode::mask && plan.on(Effect::alphaTest);
  const bool blended = material.alphaMode == AlphaMode::blend && plan.on(Effect::alphaBlend);
  out.alphaMode = cut ? AlphaMode::mask : blended ? AlphaMode::blend : AlphaMode::opaque;
  return out;
}

MaterialNeeds needsOf(const Material& material, const EffectPlan& plan) {
  const Material local = localMaterial(material, plan);
  MaterialNeeds needs;
  for (const TextureUse* use : {&local.baseColourTexture, &local.emissiveTexture})
    if (use->used()) needs.uv[use->uvSet == 1 ? 1 : 0] = true;
  needs.colours = plan.on(Effect::vertexColours);
  return needs;
}

}  // namespace acentric
