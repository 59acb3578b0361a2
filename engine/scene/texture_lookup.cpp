#include "engine/scene/texture_lookup.h"

namespace acentric {

TextureSampler::TextureSampler(const Scene& scene, const TextureUse& use) {
  if (!use.used()) return;
  const Texture& texture = scene.textures[std::size_t(use.texture)];
  if (texture.image < 0 || !scene.images[std::size_t(texture.image)]) return;
  const ColourImage& image = *scene.images[std::size_t(texture.image)];
  if (image.empty()) return;
  image_ = &image;
  wrapU_ = texture.wrapU, wrapV_ = texture.wrapV, nearest_ = texture.nearest;
}

glm::vec4 sampleColour(const Scene& scene, const TextureUse& use, glm::vec2 uv) {
  const TextureSampler sampler(scene, use);
  return sampler.used() ? sampler.colour(use.transform * glm::vec3(uv, 1), linearFromSrgbTable())
                        : glm::vec4(1);
}

glm::vec4 sampleLinear(const Scene& scene, const TextureUse& use, glm::vec2 uv) {
  const TextureSampler sampler(scene, use);
  return sampler.used() ? sampler.stored(use.transform * glm::vec3(uv, 1)) : glm::vec4(1);
}

}  // namespace acentric
