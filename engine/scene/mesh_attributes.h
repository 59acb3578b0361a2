#pragma once
/// What the vertices of a mesh carry, at a point of a triangle. `b`: weights of the triangle's 2nd and 3rd
/// corner.

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "engine/scene/scene.h"

namespace acentric {

template <class Value>
Value interpolate(const MeshArray<Value>& values, const glm::uvec3& corners, const glm::vec2& b) {
  return values[corners.x] * (1 - b.x - b.y) + values[corners.y] * b.x + values[corners.z] * b.y;
}

/// Linear RGBA in [0, 1], of a mesh that has vertex colours.
inline glm::vec4 vertexColourAt(const Mesh& mesh, const glm::uvec3& corners, const glm::vec2& b) {
  const auto& c = mesh.colours;
  return (glm::vec4(c[corners.x]) * (1 - b.x - b.y) + glm::vec4(c[corners.y]) * b.x +
          glm::vec4(c[corners.z]) * b.y) /
         255.0F;
}

/// Some of its vertices, in the order given, with all that they carry; no triangles.
inline Mesh withVertices(const Mesh& from, std::span<const std::uint32_t> vertices) {
  Mesh mesh;
  mesh.name = from.name;
  mesh.material = from.material;
  const auto take = [&](const auto& all, auto& some) {
    if (all.empty()) return;
    some.reserve(vertices.size());
    for (const std::uint32_t vertex : vertices) some.push_back(all[vertex]);
  };
  take(from.positions, mesh.positions);
  take(from.normals, mesh.normals);
  take(from.tangents, mesh.tangents);
  take(from.uv[0], mesh.uv[0]);
  take(from.uv[1], mesh.uv[1]);
  take(from.colours, mesh.colours);
  return mesh;
}

/// The coordinates that `use` reads, untransformed; empty where the mesh has none.
inline const MeshArray<glm::vec2>& coordinatesOf(const Mesh& mesh, const TextureUse& use) {
  return mesh.uv[use.uvSet == 1 ? 1 : 0];
}
inline bool hasCoordinates(const Mesh& mesh, const TextureUse& use) {
  return use.used() && !coordinatesOf(mesh, use).empty();
}

}  // namespace acentric
