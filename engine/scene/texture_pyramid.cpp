#include "engine/scene/texture_pyramid.h"

#include <algorithm>
#include <cmath>

#include "engine/image/colour.h"
#include "engine/scene/texture_lookup.h"

namespace acentric {
namespace {

glm::vec4 decoded(const Rgba8& texel, TexelKind kind) {
  const glm::vec4 stored = glm::vec4(texel) * (1 / 255.0f);
  if (kind == TexelKind::data) return stored;
  const auto& linear = linearFromSrgbTable();
  return {linear[texel.r], linear[texel.g], linear[texel.b], stored.a};
}

Rgba8 encoded(const glm::vec4& value, TexelKind kind) {
  const auto rounded = [](float v) { return static_cast<std::uint8_t>(std::lround(255 * v)); };
  if (kind == TexelKind::data)
    return {rounded(value.r), rounded(value.g), rounded(value.b), rounded(value.a)};
  return {srgbCodeFromLinear(value.r), srgbCodeFromLinear(value.g), srgbCodeFromLinear(value.b),
          rounded(value.a)};
}

Rgba8 meanOf(const ColourImage& image, const glm::ivec2& from, const glm::ivec2& to, TexelKind kind) {
  glm::vec4 sum(0), weighed(0);
  for (int y = from.y; y < to.y; ++y)
    for (int x = from.x; x < to.x; ++x) {
      const glm::vec4 value = decoded(image.at(x, y), kind);
      sum += value;
      weighed += value * value.a;
    }
  const glm::ivec2 size = to - from;
  glm::vec4 mean = sum / static_cast<float>(size.x * size.y);
  if (kind == TexelKind::cutColour && sum.a > 0) mean = {glm::vec3(weighed) / sum.a, mean.a};
  return encoded(mean, kind);
}

ColourImage halved(const ColourImage& image, TexelKind kind) {
  ColourImage half(std::max(1, image.width / 2), std::max(1, image.height / 2));
  const auto begin = [](int texel, int size, int halfSize) { return texel * size / halfSize; };
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x)
      half.at(x, y) =
          meanOf(image, {begin(x, image.width, half.width), begin(y, image.height, half.height)},
                 {begin(x + 1, image.width, half.width), begin(y + 1, image.height, half.height)}, kind);
  return half;
}

}  // namespace

TexelKind baseColourKind(const Material& material) {
  return material.alphaMode == AlphaMode::opaque ? TexelKind::colour : TexelKind::cutColour;
}

std::vector<ColourImage> halvings(const ColourImage& image, TexelKind kind) {
  std::vector<ColourImage> levels;
  for (const ColourImage* last = &image; last->width > 1 || last->height > 1; last = &levels.back())
    levels.push_back(halved(*last, kind));
  return levels;
}

TexturePyramids::TexturePyramids(const Scene& scene, const DetailRules& detail, TaskRunner& runner) {
  const auto want = [&](const TextureUse& use, TexelKind kind) {
    if (const TextureSampler sampler(scene, use); sampler.used()) pyramids_[{sampler.image(), kind}];
  };
  for (const Material& material : scene.materials) {
    if (detail.textures) {
      want(material.baseColourTexture, baseColourKind(material));
      want(material.emissiveTexture, TexelKind::colour);
      want(material.metallicRoughnessTexture, TexelKind::data);
    }
    if (detail.normalMaps) want(material.normalTexture, TexelKind::data);
  }
  std::vector<std::pair<const Key, std::vector<ColourImage>>*> all;
  for (auto& pyramid : pyramids_) all.push_back(&pyramid);
  runner.parallelFor(all.size(), [&](std::size_t i) {
    all[i]->second = halvings(*all[i]->first.first, all[i]->first.second);
  });
}

const ColourImage& TexturePyramids::level(const ColourImage& image, TexelKind kind, int level) const {
  const auto found = pyramids_.find({&image, kind});
  if (level <= 0 || found == pyramids_.end() || found->second.empty()) return image;
  return found->second[std::min(static_cast<std::size_t>(level), found->second.size()) - 1];
}

}  // namespace acentric
