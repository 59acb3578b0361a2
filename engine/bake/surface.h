#pragma once
/// The surface at a hit: where it is, how it is turned, and what its material says there.

#include <glm/glm.hpp>

#include "engine/bake/ray_scene.h"
#include "engine/bake/texture_area.h"
#include "engine/scene/material_rules.h"

namespace acentric {

struct Surface {
  glm::vec3 position{0};         ///< from the triangle's corners: more exact than along the ray
  glm::vec3 geometricNormal{0};  ///< unit, on the viewer's side
  glm::vec3 normal{0};           ///< unit, for shading, in the hemisphere of geometricNormal
  glm::vec3 rayOrigin{0};        ///< position lifted off the surface by its rounding error
  glm::vec4 baseColour{1};
  glm::vec3 emission{0};
  float metallic = 0;
  float roughness = 1;
};

/// Base colour x texture x vertex colour, alpha straight.
glm::vec4 baseColourAt(const Scene& scene, const Mesh& mesh, std::uint32_t triangle,
                       const glm::vec2& barycentric, const DetailRules& detail);

/// `kDetail` false reads neither textures nor vertex colours nor normal maps. Textures are read at the hit,
/// or over an area around it.
template <bool kDetail>
Surface surfaceAt(const Scene& scene, const Hit& hit, const glm::vec3& toViewer, const DetailRules& detail,
                  bool emission, const TextureArea* area = nullptr);

}  // namespace acentric
