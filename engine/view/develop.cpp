#include "engine/view/develop.h"

#include <algorithm>
#include <array>

namespace acentric {
namespace {

/// Of a block: rows are written, and columns read, by whole cache lines.
constexpr int kColumns = 16, kRows = 16;
constexpr int kRoom = 16;  ///< that filters need beyond their last pixel

/// Pixels [y0 - 1, y0 + kRows + 1) of a column, empty beyond the picture.
using Window = std::array<CanvasPixel, kRows + 2 + kRoom>;

void fetch(const Canvas& canvas, int x, int y0, Window& window) {
  window.fill(kEmptyPixel);
  if (x < canvas.x0 || x >= canvas.x0 + canvas.width) return;
  const int first = std::max(y0 - 1, 0), last = std::min(y0 + kRows + 1, canvas.height);
  std::copy(canvas.column(x) + first, canvas.column(x) + last, window.begin() + (first - (y0 - 1)));
}

/// Colours of at most kColumns x kRows pixels from (x0, y0) on, column by column.
using Colours = std::array<std::uint32_t, kColumns * kRows + kRoom>;

void filterBlock(const Canvas& canvas, int x0, int columns, int y0, int rows, FilterPixels filter,
                 Colours& colours) {
  std::array<Window, kColumns + 2> windows;
  for (int i = 0; i < columns + 2; ++i) fetch(canvas, x0 + i - 1, y0, windows[std::size_t(i)]);
  for (int i = 0; i < columns; ++i) {
    const Window* const w = &windows[std::size_t(i)];
    filter(w[0].data(), w[1].data(), w[2].data(), rows, colours.data() + i * kRows);
  }
}

}  // namespace

void develop(const Canvas& canvas, int x0, int x1, const std::vector<PixelSource>& sources,
             FilterPixels filter, Frame& frame, FloatImage& inverseZDepth) {
  const CanvasPixel depthBits = ~(canvas.places ? kPlaceBits : CanvasPixel(0));
  Colours filtered{};
  for (int left = x0; left < x1; left += kColumns)
    for (int top = 0; top < canvas.height; top += kRows) {
      const int columns = std::min(kColumns, x1 - left), rows = std::min(kRows, canvas.height - top);
      if (canvas.places) filterBlock(canvas, left, columns, top, rows, filter, filtered);
      if (top + 2 * kRows <= canvas.height) {  // the next block, whose lines are far from each other
        for (int i = 0; i < columns; ++i) {
          __builtin_prefetch(canvas.column(left + i) + top + kRows);
          __builtin_prefetch(canvas.column(left + i) + top + kRows + kRows / 2);
        }
        for (int j = kRows; j < 2 * kRows; ++j) {
          __builtin_prefetch(&frame.colour.at(left, top + j), 1);
          __builtin_prefetch(&frame.source.at(left, top + j), 1);
          __builtin_prefetch(&inverseZDepth.at(left, top + j), 1);
        }
      }
      for (int j = 0; j < rows; ++j) {
        Rgba8* const colour = &frame.colour.at(left, top + j);
        PixelSource* const source = &frame.source.at(left, top + j);
        float* const inverse = &inverseZDepth.at(left, top + j);
        const CanvasPixel* const row = canvas.column(left) + top + j;
        for (int i = 0; i < columns; ++i) {
          const CanvasPixel pixel = row[std::size_t(i) * std::size_t(canvas.height)];
          const std::uint32_t slot = slotOf(pixel), opaque = slot > 0 ? 0xff000000u : 0;
          const std::uint32_t own = static_cast<std::uint32_t>(pixel) & 0xffffffu;
          const std::uint32_t shown = canvas.places && slot > 0 ? filtered[std::size_t(i * kRows + j)] : own;
          colour[i] = colourOf((shown & 0xffffffu) | opaque);
          source[i] = sources[slot];
          inverse[i] = slot > 0 ? inverseZDepthOf(pixel & depthBits) : 0.0f;
        }
      }
    }
}

}  // namespace acentric
