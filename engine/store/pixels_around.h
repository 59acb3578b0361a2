#pragma once
/// Where the samples of a pixel lie in a list, and those of the pixels around it that come before.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/image/capture.h"

namespace acentric {

inline constexpr std::size_t kNoSample = ~std::size_t(0);

/// Of one column where each pixel's samples begin; behind the last row the end.
inline void findPixels(const CaptureSamples& samples, std::size_t column, std::vector<std::uint32_t>& first) {
  std::uint32_t at = samples.columnStart[column];
  const std::uint32_t end = samples.columnStart[column + 1];
  for (std::size_t row = 0; row < first.size(); ++row) {
    first[row] = at;
    while (at < end && samples.row[at] == row) ++at;
  }
}

/// The samples of one pixel.
struct PixelRange {
  std::uint32_t first = 0, end = 0;
  std::size_t at(std::uint32_t layer) const {
    return first == end ? kNoSample : std::min(first + layer, end - 1);
  }
};

/// Pixels around one that come before it: in the column before, and above. Empty beyond the image.
struct PixelsAround {
  enum Place : std::uint8_t { kBefore, kAbove, kAboveBefore, kBelowBefore, kPlaces };
  std::array<PixelRange, kPlaces> pixel;
};

}  // namespace acentric
