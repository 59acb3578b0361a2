#pragma once
/// Light baked to the surfaces themselves (mesh colours): each triangle carries a regular grid of samples in
/// barycentric coordinates, so no unwrapping is needed. It lights the local geometry with the same light as
/// the captures.
///
/// A triangle of resolution R has (R+1)(R+2)/2 samples at barycentric weights (i/R, j/R) of its 2nd and 3rd
/// corner, 0 <= i, j and i + j <= R, stored with j fastest within i. R = 0 means "no light baked": black.

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "engine/image/capture.h"

namespace acentric {

struct SurfaceLight {
  std::vector<std::uint32_t> firstSample;  ///< per scene triangle (scene-wide number), + 1 sentinel
  std::vector<std::uint16_t> resolution;   ///< per scene triangle
  /// Front-side and back-side light are separate samples: front at [first, first+n), back (flagged; where
  /// it is drawn: of double-sided and clear materials, and where an eye sees it) behind it. `light` is what
  /// leaves the surface for base colour 1, i.e. radiance = baseColour * rgb + emission; for unlit materials
  /// it is 1. Half floats; alpha unused.
  std::vector<std::uint8_t> hasBack;
  std::vector<HalfColour> light;

  bool empty() const { return light.empty(); }
  /// The samples of one side of a triangle of resolution R >= 1; null for a back that has none of its own.
  const HalfColour* samplesOf(std::uint32_t sceneTriangle, bool back) const;
  /// Interpolated light at barycentric weights (b1, b2) of corner 2 and 3.
  glm::vec3 at(std::uint32_t sceneTriangle, glm::vec2 barycentric, bool back) const;
};

/// Its channels with so many bits zero at the end, the nearest that are.
inline HalfColour roundedLight(HalfColour light, int unusedBits) {
  const unsigned step = 1u << unusedBits, largest = 0x7c00 - step;
  for (std::uint16_t* channel : {&light.r, &light.g, &light.b})
    *channel = std::uint16_t(std::min((*channel + step / 2) & ~(step - 1), largest));
  return light;
}

/// The three samples of one side around a place, and their weights, which sum to 1. Places slightly outside
/// the triangle read its border. R >= 1.
struct SurfaceCell {
  glm::uvec2 sample[3];  ///< (i, j)
  float weight[3];
};
SurfaceCell surfaceCellAt(std::uint32_t resolution, glm::vec2 barycentric);

/// Where the light of sample (i, j) is taken: moved a tenth of the spacing towards the triangle's middle, so
/// that a sample on an edge that touches a wall does not lie in the wall.
glm::vec2 surfaceSamplePlace(std::uint32_t resolution, std::uint32_t i, std::uint32_t j);

/// Light at a place of a triangle of resolution R >= 1, from its samples of one side.
glm::vec3 interpolatedLight(const HalfColour* samples, std::uint32_t resolution, glm::vec2 barycentric);

inline std::uint32_t surfaceSampleCount(std::uint32_t resolution) {
  return (resolution + 1) * (resolution + 2) / 2;
}
/// Index of sample (i, j) within one side of a triangle of resolution R.
inline std::uint32_t surfaceSampleIndex(std::uint32_t resolution, std::uint32_t i, std::uint32_t j) {
  return i * (resolution + 1) - i * (i - 1) / 2 + j;  // i = 0 first: R+1 samples, then R, ...
}

}  // namespace acentric
