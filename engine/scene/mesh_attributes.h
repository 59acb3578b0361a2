#pragma once
/// What the vertices of a mesh carry, at a point of a triangle. `b`: weights of the triangle's 2nd and 3rd
/// corner.

#include <glm/glm.hpp>
#include <vector>

#include "engine/scene/scene.h"

namespace acentric {

template <class Value>
Value interpolate(const std::vector<Value>& values, const glm::uvec3& corners, const glm::vec2& b) {
  return values[corners.x] * (1 - b.x - b.y) + values[corners.y] * b.x + values[corners.z] * b.y;
}

/// Linear RGBA in [0, 1], of a mesh that has vertex colours.
inline glm::vec4 vertexColourAt(const Mesh& mesh, const glm::uvec3& corners, const glm::vec2& b) {
  const auto& c = mesh.colours;
  return (glm::vec4(c[corners.x]) * (1 - b.x - b.y) + glm::vec4(c[corners.y]) * b.x +
          glm::vec4(c[corners.z]) * b.y) /
         255.0F;
}

/// The coordinates that `use` reads, untransformed; empty where the mesh has none.
inline const std::vector<glm::vec2>& coordinatesOf(const Mesh& mesh, const TextureUse& use) {
  return mesh.uv[use.uvSet == 1 ? 1 : 0];
}
inline bool hasCoordinates(const Mesh& mesh, const TextureUse& use) {
  return use.used() && !coordinatesOf(mesh, use).empty();
}

}  // namespace acentric
