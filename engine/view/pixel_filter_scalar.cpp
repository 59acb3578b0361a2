#include "engine/view/pixel_filter.h"

namespace acentric {
namespace {

constexpr int kPixel = 8;  ///< places are eighths of one

/// 0..256.
int weightAlong(std::uint64_t code, int pixelsAway, int perEighth) {
  const int place = static_cast<int>(code & 15u);
  const int away = (place < 8 ? place : place - 16) + kPixel * pixelsAway;
  const int weight = 256 - (away < 0 ? -away : away) * perEighth;
  return weight > 0 ? weight : 0;
}

/// 0..128.
int weightOf(std::uint64_t pixel, int x, int y) {
  if (((pixel >> 24) & 0xffu) == 0) return 0;
  const int perEighth = 32 - 4 * static_cast<int>((pixel >> 40) & 7u);
  return (weightAlong(pixel >> 32, x, perEighth) * weightAlong(pixel >> 36, y, perEighth)) >> 9;
}

std::uint32_t rootOfMean(int squares, int weights) {
  const float mean = static_cast<float>(squares) / static_cast<float>(weights);
  return static_cast<std::uint32_t>(__builtin_sqrtf(mean) + 0.5f);
}

}  // namespace

void filterPixelsScalar(const std::uint64_t* left, const std::uint64_t* middle, const std::uint64_t* right,
                        int count, std::uint32_t* colour) {
  const std::uint64_t* const columns[] = {left, middle, right};
  for (int i = 0; i < count; ++i) {
    int weights = 0, squares[3] = {};
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y) {
        const std::uint64_t pixel = columns[x + 1][i + 1 + y];
        const int weight = weightOf(pixel, x, y);
        weights += weight;
        for (int channel = 0; channel < 3; ++channel) {
          const int code = static_cast<int>((pixel >> (8 * channel)) & 0xffu);
          squares[channel] += weight * code * code;
        }
      }
    std::uint32_t out = static_cast<std::uint32_t>(middle[i + 1]) & 0xffffffu;
    if (weights > 0)
      out = rootOfMean(squares[0], weights) | rootOfMean(squares[1], weights) << 8 |
            rootOfMean(squares[2], weights) << 16;
    colour[i] = out | 0xff000000u;
  }
}

}  // namespace acentric
