#pragma once
/// From columns of canvas pixels to rows of colours, sources and depths: the inner loop of develop.h.
///
/// All variants give the same bits. Free of the standard library, as warp_kernel.h is.

#include <cstddef>
#include <cstdint>

namespace acentric {

inline constexpr int kBlockSide = 16;

/// A block of a canvas, at most kBlockSide columns and rows, and where it goes.
struct CanvasBlock {
  const std::uint64_t* pixels = nullptr;  ///< CanvasPixel, column by column
  std::ptrdiff_t columnPitch = 0;
  const std::uint32_t* sources = nullptr;  ///< PixelSource by slot
  std::uint32_t* colour = nullptr;         ///< Rgba8 words: opaque, holes 0
  std::uint16_t* source = nullptr;
  float* inverseZDepth = nullptr;  ///< 1/m, 0 in holes
  std::ptrdiff_t rowPitch = 0;     ///< pixels, of all three
};

/// Whole blocks only.
using WriteRows = void (*)(const CanvasBlock& block);

void writeRowsScalar(const CanvasBlock& block);
void writeRowsAvx2(const CanvasBlock& block);
void writeRowsAvx512(const CanvasBlock& block);

/// Smaller blocks, at the borders of the picture.
void writeRowsOfPart(const CanvasBlock& block, int columns, int rows);

}  // namespace acentric
