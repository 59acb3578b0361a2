#include "projects/gallery/generator/noise.h"

#include <cmath>
#include <limits>

namespace acentric::gallery {
namespace {

constexpr std::uint32_t mix(std::uint32_t h) {
  h ^= h >> 16;
  h *= 0x7feb352dU;
  h ^= h >> 15;
  h *= 0x846ca68bU;
  return h ^ (h >> 16);
}

constexpr int wrapped(int i, int period) { return period > 0 ? ((i % period) + period) % period : i; }

constexpr float unitOf(std::uint32_t bits) { return static_cast<float>(bits >> 8) * (1.0f / 16777216.0f); }

float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }

}  // namespace

Random::Random(std::uint64_t seed) : state_(seed * 6364136223846793005ULL + 1442695040888963407ULL) {
  next();
}

std::uint32_t Random::next() {
  const std::uint64_t old = state_;
  state_ = old * 6364136223846793005ULL + 1442695040888963407ULL;
  const auto shifted = static_cast<std::uint32_t>(((old >> 18U) ^ old) >> 27U);
  const auto turn = static_cast<std::uint32_t>(old >> 59U);
  return (shifted >> turn) | (shifted << ((32U - turn) & 31U));
}

float Random::unit() { return unitOf(next()); }
float Random::between(float low, float high) { return low + (high - low) * unit(); }
int Random::below(int count) { return static_cast<int>(unit() * static_cast<float>(count)); }

float hashUnit(int x, int y, int z, std::uint32_t seed) {
  return unitOf(mix(static_cast<std::uint32_t>(x) * 0x9e3779b1U ^
                    static_cast<std::uint32_t>(y) * 0x85ebca77U ^
                    static_cast<std::uint32_t>(z) * 0xc2b2ae3dU ^ seed * 0x27d4eb2fU));
}

float noise(const glm::vec3& p, std::uint32_t seed, int period) {
  const glm::vec3 base = glm::floor(p);
  const glm::ivec3 i(base);
  const glm::vec3 t(fade(p.x - base.x), fade(p.y - base.y), fade(p.z - base.z));
  const auto corner = [&](int dx, int dy, int dz) {
    return hashUnit(wrapped(i.x + dx, period), wrapped(i.y + dy, period), i.z + dz, seed);
  };
  const auto along = [&](int dy, int dz) { return glm::mix(corner(0, dy, dz), corner(1, dy, dz), t.x); };
  const auto across = [&](int dz) { return glm::mix(along(0, dz), along(1, dz), t.y); };
  return 2 * glm::mix(across(0), across(1), t.z) - 1;
}

float fractalNoise(const glm::vec3& p, int octaves, std::uint32_t seed, int period) {
  float sum = 0, weight = 1, total = 0, scale = 1;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += weight * noise(p * scale, seed + static_cast<std::uint32_t>(octave) * 101U,
                          period * static_cast<int>(scale));
    total += weight;
    weight *= 0.5f;
    scale *= 2;
  }
  return sum / total;
}

Cell cellAt(const glm::vec2& p, std::uint32_t seed, int period) {
  const glm::ivec2 home(glm::floor(p));
  Cell cell{std::numeric_limits<float>::max(), std::numeric_limits<float>::max(), 0};
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const glm::ivec2 at = home + glm::ivec2(dx, dy);
      const int x = wrapped(at.x, period), y = wrapped(at.y, period);
      const glm::vec2 point = glm::vec2(at) + glm::vec2(hashUnit(x, y, 1, seed), hashUnit(x, y, 2, seed));
      const float distance = glm::length(p - point);
      if (distance < cell.nearest) {
        cell.second = cell.nearest;
        cell.nearest = distance;
        cell.value = hashUnit(x, y, 3, seed);
      } else if (distance < cell.second) {
        cell.second = distance;
      }
    }
  return cell;
}

}  // namespace acentric::gallery
