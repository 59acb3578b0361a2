#pragma once
/// A picture being painted: linear colour, drawn with soft-edged marks, kept as PNG or JPEG bytes.

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

namespace acentric::gallery {

/// 0xRRGGBB, sRGB coded, as linear colour.
glm::vec3 colour(unsigned hex);

/// Linear interpolation between colours at equal steps, t in [0, 1].
glm::vec3 gradient(const std::vector<glm::vec3>& stops, float t);

class Canvas {
 public:
  Canvas(int width, int height, const glm::vec3& ground = glm::vec3(0));
  int width() const { return width_; }
  int height() const { return height_; }
  float aspect() const { return static_cast<float>(width_) / static_cast<float>(height_); }

  glm::vec3& at(int x, int y);
  const glm::vec3& at(int x, int y) const;
  float& alphaAt(int x, int y);

  /// Positions below are (x, y) in [0, aspect] x [0, 1], y downwards: a unit is the picture's height.
  void fill(const std::function<glm::vec3(const glm::vec2&)>& paint);
  /// Over what is there, where `coverage` (clamped to [0, 1]) says.
  void over(const std::function<glm::vec4(const glm::vec2&)>& paint);
  /// `inside` is a signed distance (negative inside), edges are a pixel soft; looked at only within the box.
  void mark(const glm::vec2& boxMin, const glm::vec2& boxMax,
            const std::function<float(const glm::vec2&)>& inside, const glm::vec3& tint, float opacity = 1);
  void disc(const glm::vec2& centre, float radius, const glm::vec3& tint, float opacity = 1);
  void stroke(const glm::vec2& from, const glm::vec2& to, float width, const glm::vec3& tint,
              float opacity = 1);
  void rectangle(const glm::vec2& min, const glm::vec2& max, const glm::vec3& tint, float opacity = 1);

  /// 8-bit sRGB; `withAlpha` keeps the alpha channel.
  std::vector<std::byte> encodePng(bool withAlpha) const;
  /// `quality` 1..100.
  std::vector<std::byte> encodeJpeg(int quality) const;

 private:
  std::vector<unsigned char> bytes(bool withAlpha) const;
  int width_ = 0;
  int height_ = 0;
  std::vector<glm::vec3> pixels_;
  std::vector<float> alpha_;
};

/// Tangent-space normal map (PNG) of a height field in metres; the picture covers `metres` and repeats.
std::vector<std::byte> normalMapPng(int size, float metres, const std::function<float(int x, int y)>& height);

}  // namespace acentric::gallery
