#pragma once
/// Reading textures on the CPU: bilinear with wrap modes, level 0, sRGB decoded to linear where the use is a
/// colour. One routine for bake, truth and the software renderer, so that their pictures agree.

#include <cmath>
#include <glm/glm.hpp>

#include "engine/image/colour.h"
#include "engine/scene/scene.h"

namespace acentric {

/// Linear RGBA of a colour texture (sRGB in the file; alpha as it is). `uv` is untransformed.
glm::vec4 sampleColour(const Scene& scene, const TextureUse& use, glm::vec2 uv);
/// RGBA as stored, in [0,1] (normal and metallic-roughness maps).
glm::vec4 sampleLinear(const Scene& scene, const TextureUse& use, glm::vec2 uv);

/// The same for many places of one use.
class TextureSampler {
 public:
  TextureSampler() = default;
  /// Refers to the scene's image.
  TextureSampler(const Scene& scene, const TextureUse& use);
  bool used() const { return image_ != nullptr; }  ///< else the texture is white
  const ColourImage* image() const { return image_; }
  Wrap wrapU() const { return wrapU_; }
  Wrap wrapV() const { return wrapV_; }
  bool nearest() const { return nearest_; }
  /// The same of a smaller copy of the image (texture_pyramid.h).
  TextureSampler ofLevel(const ColourImage& level) const {
    TextureSampler of = *this;
    of.image_ = &level;
    return of;
  }

  /// `at`: transformed texture coordinates. `decode`: from Rgba8.
  template <class Decode>
  glm::vec4 sample(glm::vec2 at, const Decode& decode) const {
    const int width = image_->width, height = image_->height;
    const float x = wrapCoordinate(at.x, wrapU_) * float(width);
    const float y = wrapCoordinate(at.y, wrapV_) * float(height);
    if (nearest_) return decode(image_->at(glm::min(int(x), width - 1), glm::min(int(y), height - 1)));
    const float left = floorOf(x - 0.5f), top = floorOf(y - 0.5f);
    const float fx = x - 0.5f - left, fy = y - 0.5f - top;
    const int x0 = wrapTexel(int(left), width, wrapU_), x1 = wrapTexel(int(left) + 1, width, wrapU_);
    const int y0 = wrapTexel(int(top), height, wrapV_), y1 = wrapTexel(int(top) + 1, height, wrapV_);
    const glm::vec4 upper = glm::mix(decode(image_->at(x0, y0)), decode(image_->at(x1, y0)), fx);
    const glm::vec4 lower = glm::mix(decode(image_->at(x0, y1)), decode(image_->at(x1, y1)), fx);
    return glm::mix(upper, lower, fy);
  }
  glm::vec4 stored(glm::vec2 at) const {
    return sample(at, [](const Rgba8& p) { return glm::vec4(p) * (1 / 255.0f); });
  }
  glm::vec4 colour(glm::vec2 at, const std::array<float, 256>& linearFromSrgb) const {
    return sample(at, [&](const Rgba8& p) {
      return glm::vec4(linearFromSrgb[p.r], linearFromSrgb[p.g], linearFromSrgb[p.b],
                       float(p.a) * (1 / 255.0f));
    });
  }

 private:
  /// Of a finite number; a call to the library's costs more than the texel.
  static float floorOf(float t) {
    if (!(std::abs(t) < 0x1p23f)) return t;  // has no fraction
    const float whole = float(int(t));
    return whole > t ? whole - 1 : whole;
  }
  /// Brought into [0, 1] by the wrap mode. Far or broken coordinates stay defined: beyond 2^23 a float has no
  /// fraction left, and what is not finite reads the texture's corner.
  static float wrapCoordinate(float t, Wrap wrap) {
    if (!std::isfinite(t)) return 0;
    if (wrap == Wrap::repeat) return t - floorOf(t);
    if (wrap == Wrap::clamp) return glm::clamp(t, 0.0f, 1.0f);
    const float period = t - 2 * floorOf(t * 0.5f);
    return period > 1 ? 2 - period : period;
  }
  static int wrapTexel(int texel, int size, Wrap wrap) {
    if (wrap == Wrap::repeat) return texel < 0 ? texel + size : texel >= size ? texel - size : texel;
    return glm::clamp(texel, 0, size - 1);  // a mirrored edge repeats its last texel
  }

  const ColourImage* image_ = nullptr;
  Wrap wrapU_{}, wrapV_{};
  bool nearest_ = false;
};

}  // namespace acentric
