#pragma once
/// Where the samples of a pixel lie in a list, and those of the pixels around it that come before.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace acentric {

inline constexpr std::size_t kNoSample = ~std::size_t(0);

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
