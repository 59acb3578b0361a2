#pragma once
/// What kernels write, and its memory.

#include <cstddef>
#include <vector>

#include "engine/view/canvas.h"
#include "engine/view/warp_kernel.h"

namespace acentric {

/// All that the arrays say of one splat.
struct Splat {
  int x = 0, y = 0;         ///< of its top left pixel
  int side = 1;             ///< pixels
  std::uint32_t index = 0;  ///< of its sample
  CanvasPixel pixel = 0;    ///< SplatArrays::pixels
};

inline int columnOf(const SplatArrays& splats, int i) {
  return static_cast<std::int16_t>(splats.corners[i] & 0xffffu);
}
inline Splat splatAt(const SplatArrays& splats, int i) {
  return {columnOf(splats, i), static_cast<std::int16_t>(splats.corners[i] >> 16),
          static_cast<int>(splats.sides[i]), splats.indices[i], splats.pixels[i]};
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
           {&arrays_.steps, &arrays_.firsts, &arrays_.corners, &arrays_.sides, &arrays_.indices}) {
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
