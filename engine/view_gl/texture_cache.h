#pragma once
/// The scene's images as sRGB textures, and samplers for their wrap modes and filters. One level without
/// mipmaps: the CPU reads level 0 (scene/texture_lookup.h), and local geometry is near the eye.

#include <map>
#include <memory>
#include <tuple>

#include "engine/base/result.h"
#include "engine/scene/scene.h"
#include "engine/view_gl/gl_object.h"

namespace acentric {

/// Halved in linear light until both sides are at most `limit` pixels.
ColourImage downscaledTo(const ColourImage& image, int limit);

class TextureCache {
 public:
  /// Texture of an image, uploaded at the first call.
  Result<GLuint> texture(const std::shared_ptr<const ColourImage>& image);
  GLuint sampler(const Texture& texture);
  /// Drops textures whose image is gone from memory.
  void dropGone();
  std::size_t count() const { return textures_.size(); }

 private:
  struct Entry {
    std::weak_ptr<const ColourImage> owner;
    GlTexture texture;
  };
  std::map<const ColourImage*, Entry> textures_;
  std::map<std::tuple<Wrap, Wrap, bool>, GlSampler> samplers_;
};

}  // namespace acentric
