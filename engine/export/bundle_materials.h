#pragma once
/// Materials as bundles keep them: what the effect plan leaves of them for near surfaces, so that whoever
/// reads them draws all that they say.

#include "engine/scene/effect_plan.h"
#include "engine/scene/scene.h"

namespace acentric {

Material localMaterial(const Material& material, const EffectPlan& plan);

/// Attributes of vertices that near surfaces of a material read.
struct MaterialNeeds {
  bool uv[2] = {};
  bool colours = false;
};
MaterialNeeds needsOf(const Material& material, const EffectPlan& plan);

}  // namespace acentric
