#pragma once
/// What a sample of a capture stands for on a surface, and the mean of a texture over it. A sample has one
/// depth, but its colour is seen as that of all the surface up to the next sample: a floor far away has many
/// tiles in it.

#include <glm/glm.hpp>
#include <optional>

#include "engine/bake/ray_scene.h"
#include "engine/scene/texture_pyramid.h"

namespace acentric {

/// How the unit direction of a camera's rays changes from one sample to the next.
struct SampleSpread {
  glm::vec3 across{0};  ///< to the next column
  glm::vec3 along{0};   ///< to the next row
  float before = 0;     ///< metres of the way ahead of the ray's origin, as from the camera to a mirror
};

class TextureArea {
 public:
  /// Reads along the longer side at most; along the shorter one, two where it is longer than a texel.
  static constexpr int kMostReads = 16;

  /// Of a sample that sees the hit in `direction`; a surface seen edge on has one as long as the triangle.
  TextureArea(const TexturePyramids& pyramids, const Scene& scene, const Hit& hit, const glm::vec3& direction,
              const SampleSpread& spread);

  /// The mean of a texture over that part of the area that lies in the triangle, around the hit, as its kind
  /// is averaged and decoded; white where the texture is not used. Where the area is no larger than a texel,
  /// what one read gives. `corners`: texture coordinates, untransformed.
  glm::vec4 mean(const Scene& scene, const TextureUse& use, TexelKind kind, const glm::mat3x2& corners) const;

 private:
  const TexturePyramids& pyramids_;
  glm::vec2 middle_;          // barycentric, as hits have it
  glm::vec2 across_, along_;  // of the area's sides
};

/// Whatever surfaces a ray of a sample meets.
struct SampleFootprint {
  const TexturePyramids* textures = nullptr;  ///< null: none is averaged
  SampleSpread spread;

  std::optional<TextureArea> on(const Scene& scene, const Hit& hit, const glm::vec3& direction) const {
    if (textures == nullptr) return {};
    return TextureArea(*textures, scene, hit, direction, spread);
  }
  /// Of the ray that a mirror sends on, whose origin is that many metres on its way.
  SampleFootprint mirrored(const glm::vec3& normal, float before) const {
    return {textures, {glm::reflect(spread.across, normal), glm::reflect(spread.along, normal), before}};
  }
};

}  // namespace acentric
