#pragma once
/// Pictures of charts (surface_charts.h), before they go to an atlas: which triangle a texel shows, what lies
/// around them, and how small a picture may get.

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/image/image.h"

namespace acentric {

/// Of texels around a chart's rectangle, so that filtering, and one smaller mip level, never read another's.
inline constexpr int kChartBorder = 2;

/// What a texel shows.
struct TexelOwner {
  static constexpr std::uint32_t kNone = 0xffffffff;
  std::uint32_t triangle = kNone;  ///< of those given
  /// Weights of its 2nd and 3rd corner, at the texel's middle or else at the place of the triangle that is
  /// nearest to it.
  glm::vec2 barycentric{0};
  float distance = 0;  ///< texels between them
};

/// Texels farther from all triangles have no owner: linear filters within triangles do not read them.
inline constexpr float kOwnedWithin = 1.5F;

/// Triangles in texels, of a picture of `size` texels with kChartBorder around it: row by row, from
/// (-kChartBorder, -kChartBorder) on. The nearest triangle owns a texel, of those equally near the first.
std::vector<TexelOwner> ownersOf(std::span<const std::array<glm::dvec2, 3>> triangles,
                                 const glm::ivec2& size);

/// The place of a triangle nearest to `p`, as weights of its 2nd and 3rd corner.
glm::dvec2 nearestWithin(const std::array<glm::dvec2, 3>& triangle, const glm::dvec2& p);

/// Texels with `known` 0 take the mean of the known ones of the smallest square of 2, 4, 8, .. texels around
/// them that has any: what smaller mip levels show of the known ones is then their own. Squares begin at
/// multiples of their size. Without any known ones nothing changes.
void fillUnknown(ColourImage& picture, const std::vector<char>& known);

/// A chart's picture with its border.
struct ChartPicture {
  ColourImage image;  ///< size + 2 * kChartBorder
  glm::dvec2 texelsPerMetre{1};
  glm::ivec2 size() const { return {image.width - 2 * kChartBorder, image.height - 2 * kChartBorder}; }
};

/// Half as many texels across, down or both, as often as bilinear filtering of them comes within
/// kShrinkError of the picture in each 8 x 8 of its texels that `shown` has (row by row, border and all).
ChartPicture shrunk(ChartPicture picture, const std::vector<char>& shown);

/// Codes of 8 bits, root of mean squares.
inline constexpr double kShrinkError = 1.5;

}  // namespace acentric
