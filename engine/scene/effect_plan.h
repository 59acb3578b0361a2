#pragma once
/// Which effects a scene calls for, each with its reason. Bake and viewers take their kernels and passes from
/// it: what is off costs no ray, no branch, no pass, no byte.

#include <array>
#include <cstdint>
#include <map>
#include <string>

#include "engine/base/hash.h"
#include "engine/scene/scene.h"

namespace acentric {

enum class Effect : std::uint8_t {
  textures,
  vertexColours,
  alphaTest,
  alphaBlend,
  emission,
  directionalLights,
  pointLights,
  spotLights,
  areaLights,
  sky,
  hardShadows,
  softShadows,
  ambientOcclusion,
  diffuseInterreflection,
  mirrorReflection,
  transmission,
  normalMaps,
  unlit,
};
inline constexpr int kEffectCount = 18;

const char* nameOf(Effect effect);   ///< camelCase word, for files and options
const char* labelOf(Effect effect);  ///< for people

struct EffectState {
  bool calledFor = false;  ///< by the scene
  bool on = false;         ///< what bake and viewers do: calledFor, or the override
  bool overridden = false;
  std::string reason;  ///< names the materials or lights: "3 materials with textures: Floor, Wall, frame"
};

struct EffectPlan {
  std::array<EffectState, kEffectCount> effects;
  const EffectState& operator[](Effect e) const { return effects[std::size_t(e)]; }
  EffectState& operator[](Effect e) { return effects[std::size_t(e)]; }
  bool on(Effect e) const { return (*this)[e].on; }
  void addTo(Hasher& hasher) const;  ///< which are on
};

using EffectOverrides = std::map<Effect, bool>;

EffectPlan planEffects(const Scene& scene, const EffectOverrides& overrides = {});

}  // namespace acentric
