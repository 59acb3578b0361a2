#pragma once
/// What kernels write, and its memory.

#include <cstddef>
#include <vector>

#include "engine/view/canvas.h"
#include "engine/view/warp_kernel.h"

namespace acentric {

/// All that the arrays say of one splat.
struct Splat {
  int x = 0, y = 0;            ///< of its top left pixel
  int width = 1, height = 1;   ///< pixels
  int placeX = 0, placeY = 0;  ///< of its sample, eighths of a pixel from its left and upper border
  std::uint32_t index = 0;     ///< of its sample
  std::uint32_t spread = 0;    ///< SplatArrays::indices
  CanvasPixel pixel = 0;       ///< SplatArrays::pixels
};

/// Of a word of SplatArrays::indices.
inline std::uint32_t sampleOf(std::uint32_t index) { return index & 0xfffffffu; }
inline std::uint32_t sampleOf(const SplatArrays& splats, int i) { return sampleOf(splats.indices[i]); }
inline int columnOf(const SplatArrays& splats, int i) {
  return static_cast<std::int16_t>(splats.corners[i] & 0xffffu);
}
inline Splat splatAt(const SplatArrays& splats, int i) {
  const auto byte = [&](int k) { return static_cast<int>(splats.sizes[i] >> (8 * k) & 0xffu); };
  return {columnOf(splats, i),
          static_cast<std::int16_t>(splats.corners[i] >> 16),
          byte(0),
          byte(1),
          byte(2),
          byte(3),
          sampleOf(splats, i),
          splats.indices[i] >> 28,
          splats.pixels[i]};
}

/// `samples` and their colours.
inline SampleColumn sampleColumn(const float* rowTangent, const PackedSample* samples, const Rgba8* colour) {
  return {rowTangent, samples, reinterpret_cast<const unsigned char*>(colour)};
}

class SplatMemory {
 public:
  /// For so many samples.
  const SplatArrays& room(std::size_t samples) {
    const std::size_t size = samples + kSampleRoom;
    if (pixels_.size() < size) {
      pixels_.resize(size);
      words_.resize(kWordArrays * size);
      std::uint32_t* words = words_.data();
      arrays_.pixels = pixels_.data();
      for (std::uint32_t** array :
           {&arrays_.steps, &arrays_.firsts, &arrays_.corners, &arrays_.sizes, &arrays_.indices}) {
        *array = words;
        words += size;
      }
    }
    return arrays_;
  }

 private:
  static constexpr std::size_t kWordArrays = 5;
  std::vector<CanvasPixel> pixels_;
  std::vector<std::uint32_t> words_;
  SplatArrays arrays_;
};

}  // namespace acentric
