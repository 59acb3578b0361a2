#include "engine/view_gl/texture_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/image/colour.h"
#include "engine/view_gl/gl_check.h"

namespace acentric {
namespace {

GLint wrapMode(Wrap wrap) {
  switch (wrap) {
    case Wrap::repeat:
      return GL_REPEAT;
    case Wrap::clamp:
      return GL_CLAMP_TO_EDGE;
    case Wrap::mirror:
      return GL_MIRRORED_REPEAT;
  }
  return GL_REPEAT;
}

ColourImage halved(const ColourImage& image) {
  const auto& linear = linearFromSrgbTable();
  ColourImage half(std::max(1, image.width / 2), std::max(1, image.height / 2));
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x) {
      glm::vec4 sum(0);
      for (int dy : {0, 1})
        for (int dx : {0, 1}) {
          const Rgba8& p =
              image.at(std::min(2 * x + dx, image.width - 1), std::min(2 * y + dy, image.height - 1));
          sum += glm::vec4(linear[p.r], linear[p.g], linear[p.b], float(p.a) / 255);
        }
      const auto code = [](float value) { return std::uint8_t(std::lround(255 * srgbFromLinear(value))); };
      half.at(x, y) = Rgba8(code(sum.r / 4), code(sum.g / 4), code(sum.b / 4),
                            std::uint8_t(std::lround(sum.a * 255 / 4)));
    }
  return half;
}

}  // namespace

ColourImage downscaledTo(const ColourImage& image, int limit) {
  ColourImage scaled = image;
  while (std::max(scaled.width, scaled.height) > std::max(limit, 1)) scaled = halved(scaled);
  return scaled;
}

Result<GLuint> TextureCache::texture(const std::shared_ptr<const ColourImage>& image) {
  auto found = textures_.find(image.get());
  if (found != textures_.end() && found->second.owner.lock() == image) return found->second.texture.name();
  if (found != textures_.end()) textures_.erase(found);

  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  ColourImage smaller;
  const bool fits = std::max(image->width, image->height) <= limit;
  if (!fits) smaller = downscaledTo(*image, limit);
  const ColourImage& pixels = fits ? *image : smaller;

  GlTexture texture = GlTexture::make();
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, texture.name());
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_SRGB8_ALPHA8, pixels.width, pixels.height);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, pixels.width, pixels.height, GL_RGBA, GL_UNSIGNED_BYTE,
                  pixels.pixels.data());
  const std::string doing = fmt::format("uploading a texture of {}x{} pixels", pixels.width, pixels.height);
  if (Status uploaded = checkGl(doing.c_str()); !uploaded) return tl::unexpected(uploaded.error());
  const GLuint name = texture.name();
  textures_.emplace(image.get(), Entry{image, std::move(texture)});
  return name;
}

GLuint TextureCache::sampler(const Texture& texture) {
  GlSampler& sampler = samplers_[{texture.wrapU, texture.wrapV, texture.nearest}];
  if (!sampler) {
    sampler = GlSampler::make();
    const GLint filter = texture.nearest ? GL_NEAREST : GL_LINEAR;
    glSamplerParameteri(sampler.name(), GL_TEXTURE_MIN_FILTER, filter);
    glSamplerParameteri(sampler.name(), GL_TEXTURE_MAG_FILTER, filter);
    glSamplerParameteri(sampler.name(), GL_TEXTURE_WRAP_S, wrapMode(texture.wrapU));
    glSamplerParameteri(sampler.name(), GL_TEXTURE_WRAP_T, wrapMode(texture.wrapV));
  }
  return sampler.name();
}

void TextureCache::dropGone() {
  std::erase_if(textures_, [](const auto& entry) { return entry.second.owner.expired(); });
}

}  // namespace acentric
