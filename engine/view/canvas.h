#pragma once
/// The picture while it is being painted: column by column, because a capture's columns fall on nearly
/// vertical lines, so that successive samples write to neighbouring memory. One 64-bit word a pixel: a
/// splat's pixel is one store.

#include <bit>
#include <cstdint>
#include <cstring>
#include <vector>

#include "engine/image/image.h"
#include "engine/view/column_culling.h"

namespace acentric {

/// High half: inverse depth along the view axis (float bits, 1/m; -1 = nothing yet, 0 = sky). Low half: slot
/// of the piece in the alpha byte (0 = hole), then blue, green, red.
using CanvasPixel = std::uint64_t;

inline constexpr int kMaxSlots = 255;

constexpr CanvasPixel canvasPixel(std::uint32_t colourAndSlot, float inverseZDepth) {
  return (CanvasPixel(std::bit_cast<std::uint32_t>(inverseZDepth)) << 32) | colourAndSlot;
}
constexpr float inverseZDepthOf(CanvasPixel pixel) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(pixel >> 32));
}
constexpr std::uint32_t slotOf(CanvasPixel pixel) { return static_cast<std::uint32_t>(pixel) >> 24; }

inline constexpr CanvasPixel kSlotBits = 0xff000000;

inline constexpr CanvasPixel kEmptyPixel = canvasPixel(0, -1.0f);

inline std::uint32_t wordOf(const Rgba8& colour) {
  std::uint32_t word = 0;
  std::memcpy(&word, &colour, sizeof word);
  return word;
}
inline Rgba8 colourOf(std::uint32_t word) {
  Rgba8 colour;
  std::memcpy(&colour, &word, sizeof word);
  return colour;
}

/// By pixel of the picture, row by row: what covers it once all captures are drawn.
using CoverImage = Image<std::uint32_t>;
inline constexpr std::uint32_t kUncovered = 0xffffffff;

/// Of a picture, or of some of its columns.
struct Canvas {
  int x0 = 0;  ///< its first column's place in the picture
  int width = 0;
  int height = 0;
  std::vector<CanvasPixel> pixels;  ///< [(x - x0) * height + y]
  /// The sample last blended into each pixel, 0 = none; empty if nothing is blended.
  std::vector<std::uint64_t> stamps;
  /// What that left of the pixel's low half: a pixel that has another one by now was painted since, and its
  /// stamp no longer counts.
  std::vector<std::uint32_t> blended;
  std::vector<std::uint8_t> mirrors;  ///< the mirror that each pixel shows, 0 = none; empty if none is needed
  /// What such a pixel was painted: one that is another by now was painted since, and shows no mirror any
  /// more (settleMirrors).
  std::vector<CanvasPixel> mirrorPixels;

  PixelRect rect() const { return {x0, 0, x0 + width, height}; }
  std::size_t indexOf(int x) const { return std::size_t(x - x0) * std::size_t(height); }
  /// Takes away mirrors that were painted over.
  void settleMirrors() {
    for (std::size_t i = 0; i < mirrors.size(); ++i)
      if (mirrors[i] != 0 && mirrorPixels[i] != pixels[i]) mirrors[i] = 0;
  }
  CanvasPixel* column(int x) { return pixels.data() + indexOf(x); }
  const CanvasPixel* column(int x) const { return pixels.data() + indexOf(x); }
};

}  // namespace acentric
