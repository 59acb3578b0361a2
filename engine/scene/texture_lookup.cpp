#include "engine/scene/texture_lookup.h"

#include <cmath>

#include "engine/image/colour.h"

namespace acentric {
namespace {

/// A texture coordinate brought into [0, 1] by the wrap mode. Far or broken coordinates stay defined: beyond
/// 2^23 a float has no fraction left, and what is not finite reads the texture's corner.
float wrapCoordinate(float t, Wrap wrap) {
  if (!std::isfinite(t)) return 0;
  switch (wrap) {
    case Wrap::repeat:
      return t - std::floor(t);
    case Wrap::clamp:
      return glm::clamp(t, 0.0f, 1.0f);
    case Wrap::mirror: {
      const float period = t - 2 * std::floor(t * 0.5f);
      return period > 1 ? 2 - period : period;
    }
  }
  return 0;
}

int wrapTexel(int texel, int size, Wrap wrap) {
  if (wrap == Wrap::repeat) return texel < 0 ? texel + size : texel >= size ? texel - size : texel;
  return glm::clamp(texel, 0, size - 1);  // a mirrored edge repeats its last texel
}

template <class Decode>
glm::vec4 sample(const Scene& scene, const TextureUse& use, glm::vec2 uv, const Decode& decode) {
  if (!use.used()) return glm::vec4(1);
  const Texture& texture = scene.textures[std::size_t(use.texture)];
  if (texture.image < 0 || !scene.images[std::size_t(texture.image)]) return glm::vec4(1);
  const ColourImage& image = *scene.images[std::size_t(texture.image)];
  if (image.empty()) return glm::vec4(1);

  const glm::vec2 at = use.transform * glm::vec3(uv, 1);
  const float x = wrapCoordinate(at.x, texture.wrapU) * float(image.width);
  const float y = wrapCoordinate(at.y, texture.wrapV) * float(image.height);
  if (texture.nearest)
    return decode(image.at(glm::min(int(x), image.width - 1), glm::min(int(y), image.height - 1)));

  const float left = std::floor(x - 0.5f);
  const float top = std::floor(y - 0.5f);
  const float fx = x - 0.5f - left;
  const float fy = y - 0.5f - top;
  const int x0 = wrapTexel(int(left), image.width, texture.wrapU);
  const int x1 = wrapTexel(int(left) + 1, image.width, texture.wrapU);
  const int y0 = wrapTexel(int(top), image.height, texture.wrapV);
  const int y1 = wrapTexel(int(top) + 1, image.height, texture.wrapV);
  const glm::vec4 upper = glm::mix(decode(image.at(x0, y0)), decode(image.at(x1, y0)), fx);
  const glm::vec4 lower = glm::mix(decode(image.at(x0, y1)), decode(image.at(x1, y1)), fx);
  return glm::mix(upper, lower, fy);
}

}  // namespace

glm::vec4 sampleColour(const Scene& scene, const TextureUse& use, glm::vec2 uv) {
  const auto& linear = linearFromSrgbTable();
  return sample(scene, use, uv, [&](const Rgba8& p) {
    return glm::vec4(linear[p.r], linear[p.g], linear[p.b], float(p.a) * (1 / 255.0f));
  });
}

glm::vec4 sampleLinear(const Scene& scene, const TextureUse& use, glm::vec2 uv) {
  return sample(scene, use, uv, [](const Rgba8& p) { return glm::vec4(p) * (1 / 255.0f); });
}

}  // namespace acentric
