#pragma once
/// Textures at half the size, a quarter and so on, for samples that stand for more than a texel: the mean of
/// what they cover instead of whatever lies in their middle.

#include <map>
#include <utility>
#include <vector>

#include "engine/base/task_runner.h"
#include "engine/scene/material_rules.h"
#include "engine/scene/scene.h"

namespace acentric {

/// What a texture's numbers are, and so how they are averaged.
enum class TexelKind : std::uint8_t {
  data,       ///< as stored: normals, metallic and roughness
  colour,     ///< sRGB: in linear light
  cutColour,  ///< the same, each texel by its alpha: what is cut away has no colour
};

/// The kind of a material's base colour texture.
TexelKind baseColourKind(const Material& material);

/// Each half as wide and high as the one before, down to one texel; the image itself is not among them. Where
/// a size is odd, a texel is the mean of three.
std::vector<ColourImage> halvings(const ColourImage& image, TexelKind kind);

/// The halvings of all textures that the materials of a scene read under `detail`.
class TexturePyramids {
 public:
  TexturePyramids(const Scene& scene, const DetailRules& detail, TaskRunner& runner);
  bool any() const { return !pyramids_.empty(); }
  /// Of an image of the scene; the coarsest there is where `level` is beyond it. Level 0 is the image itself.
  const ColourImage& level(const ColourImage& image, TexelKind kind, int level) const;

 private:
  using Key = std::pair<const ColourImage*, TexelKind>;
  std::map<Key, std::vector<ColourImage>> pyramids_;
};

}  // namespace acentric
