#pragma once
/// What mirrors and what they show are made of.

#include "scene_builder.h"

namespace acentric::test {

inline Material silver(glm::vec3 colour = {0.9f, 0.8f, 0.7f}) {
  Material m;
  m.baseColour = glm::vec4(colour, 1);
  m.roughness = 0;
  return m;
}
inline Material glowing(glm::vec3 colour) {
  Material m = matte(colour);
  m.unlit = true;
  return m;
}

}  // namespace acentric::test
