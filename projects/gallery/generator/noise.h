#pragma once
/// Chance with a memory: hashes, a small generator and smooth noise that give the same numbers on every
/// machine. Nothing here uses <random>'s distributions, whose results are not fixed by the standard.

#include <cstdint>
#include <glm/glm.hpp>

namespace acentric::gallery {

/// Uniform numbers from a seed (PCG).
class Random {
 public:
  explicit Random(std::uint64_t seed);
  float unit();                          ///< [0, 1)
  float between(float low, float high);  ///< [low, high)
  int below(int count);                  ///< 0 .. count - 1

 private:
  std::uint32_t next();
  std::uint64_t state_;
};

/// Uniform in [0, 1), fixed by the lattice point and the seed.
float hashUnit(int x, int y, int z, std::uint32_t seed);

/// Smooth noise in [-1, 1], features of size 1. With `period` > 0 it repeats after so many units in x and y.
float noise(const glm::vec3& p, std::uint32_t seed, int period = 0);
/// Octaves of it, each half as large and half as strong, still within [-1, 1].
float fractalNoise(const glm::vec3& p, int octaves, std::uint32_t seed, int period = 0);

/// Distances to the nearest and second nearest of scattered points (one in each unit square), and the
/// nearest's hash.
struct Cell {
  float nearest = 0;
  float second = 0;
  float value = 0;  ///< [0, 1), the same in the whole cell
};
Cell cellAt(const glm::vec2& p, std::uint32_t seed, int period = 0);

}  // namespace acentric::gallery
