#pragma once
/// Points of the unit square for sampling lights and directions: the first two dimensions of Sobol's
/// sequence, so that any 2^k of them are spread evenly, scrambled by where in the world the shaded point
/// lies. Whoever shades a place (any camera, the surfaces' own light, the reference) draws the same points
/// for it, and so finds the same light to the last bit.

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace acentric {

/// Mixes bits well (the finaliser of MurmurHash3).
inline std::uint32_t mixBits(std::uint32_t h) {
  h = (h ^ (h >> 16)) * 0x85ebca6bu;
  h = (h ^ (h >> 13)) * 0xc2b2ae35u;
  return h ^ (h >> 16);
}

/// Two directions across a unit one.
class Across {
 public:
  explicit Across(const glm::vec3& axis) {
    const glm::vec3 other = std::abs(axis.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
    first_ = glm::normalize(glm::cross(other, axis));
    second_ = glm::cross(axis, first_);
  }
  glm::vec3 at(float x, float y) const { return first_ * x + second_ * y; }

 private:
  glm::vec3 first_, second_;
};

class PositionSamples {
 public:
  /// Metres, the side of the cubes that share a scramble: coarser than positions' rounding, finer than a
  /// sample.
  explicit PositionSamples(float cell) : inverseCell_(cell > 0 && std::isfinite(1 / cell) ? 1 / cell : 1) {}

  /// For one shaded point.
  class Points {
   public:
    explicit Points(std::uint32_t seed) : first_(mixBits(seed)), second_(mixBits(seed ^ 0x9e3779b9u)) {}
    glm::vec2 at(std::uint32_t k) const {
      std::uint32_t x = 0, y = 0;
      for (std::uint32_t n = k, bit = 1u << 31, column = 1u << 31; n != 0;
           n >>= 1, bit >>= 1, column ^= column >> 1)
        if (n & 1) x ^= bit, y ^= column;
      // 24 bits, exactly representable: never 1.
      return glm::vec2(float((x ^ first_) >> 8), float((y ^ second_) >> 8)) * (1.0f / (1 << 24));
    }

   private:
    std::uint32_t first_, second_;
  };

  /// `stream` keeps the draws of different lights at one point apart.
  Points at(const glm::vec3& position, std::uint32_t stream) const {
    const auto cell = [&](float x) {
      // Shifted, since walls like to stand where cubes would meet, and rounding would choose between them.
      return std::uint32_t(std::int64_t(std::floor(double(x) * double(inverseCell_) + 0.382)));
    };
    return Points(
        mixBits(cell(position.x) ^ mixBits(cell(position.y) ^ mixBits(cell(position.z) ^ mixBits(stream)))));
  }

 private:
  float inverseCell_;
};

}  // namespace acentric
