#pragma once
/// What a material means to the tracer under one effect plan. An effect that is off turns its materials into
/// plain opaque ones, once, here: no kernel asks the plan again.

#include <vector>

#include "engine/scene/effect_plan.h"
#include "engine/scene/scene.h"

namespace acentric {

struct MaterialRules {
  bool masked = false;        ///< cut out where alpha < alphaCutoff
  bool blended = false;       ///< alpha blend: alpha from the base colour
  bool transmissive = false;  ///< glass: alpha from the viewing angle
  bool mirror = false;        ///< metal that may be smooth enough to show a picture
  bool unlit = false;
  /// Light passes, wholly or in part.
  bool clear() const { return blended || transmissive; }
};

std::vector<MaterialRules> materialRules(const Scene& scene, const EffectPlan& plan);

/// Which details of a surface the plan reads.
struct DetailRules {
  bool textures = false;
  bool vertexColours = false;
  bool normalMaps = false;
  bool any() const { return textures || vertexColours || normalMaps; }
};

DetailRules detailRules(const EffectPlan& plan);

}  // namespace acentric
