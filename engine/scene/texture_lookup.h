#pragma once
/// Reading textures on the CPU: bilinear with wrap modes, level 0, sRGB decoded to linear where the use is a
/// colour. One routine for bake, truth and the software renderer, so that their pictures agree.

#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <utility>

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
    const Place place = placeOf(at);
    if (nearest_) return decode(image_->at(place.cell.x, place.cell.y));
    const auto [x0, x1] = between(place.cell.x, image_->width, wrapU_);
    const auto [y0, y1] = between(place.cell.y, image_->height, wrapV_);
    const glm::vec4 upper = glm::mix(decode(image_->at(x0, y0)), decode(image_->at(x1, y0)), place.within.x);
    const glm::vec4 lower = glm::mix(decode(image_->at(x0, y1)), decode(image_->at(x1, y1)), place.within.x);
    return glm::mix(upper, lower, place.within.y);
  }
  /// Between which texels a place is read: that of the cell and the next, both ways, from -1 to the image's
  /// size less one; of the nearest texel that itself.
  glm::ivec2 cellAt(glm::vec2 at) const { return placeOf(at).cell; }
  std::array<Rgba8, 4> texelsOf(glm::ivec2 cell) const {
    if (nearest_) cell = glm::max(cell, glm::ivec2(0));
    auto [x0, x1] = between(cell.x, image_->width, wrapU_);
    auto [y0, y1] = between(cell.y, image_->height, wrapV_);
    if (nearest_) x1 = x0, y1 = y0;
    return {image_->at(x0, y0), image_->at(x1, y0), image_->at(x0, y1), image_->at(x1, y1)};
  }
  bool operator==(const TextureSampler&) const = default;
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
  struct Place {
    glm::ivec2 cell;
    glm::vec2 within{0};  ///< 0..1
  };
  Place placeOf(glm::vec2 at) const {
    const int width = image_->width, height = image_->height;
    const float x = wrapCoordinate(at.x, wrapU_) * float(width);
    const float y = wrapCoordinate(at.y, wrapV_) * float(height);
    if (nearest_) return {{glm::min(int(x), width - 1), glm::min(int(y), height - 1)}};
    const float left = floorOf(x - 0.5f), top = floorOf(y - 0.5f);
    return {{int(left), int(top)}, {x - 0.5f - left, y - 0.5f - top}};
  }
  static std::pair<int, int> between(int cell, int size, Wrap wrap) {
    return {wrapTexel(cell, size, wrap), wrapTexel(cell + 1, size, wrap)};
  }
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
