#include "engine/view/develop.h"

#include <algorithm>
#include <array>

namespace acentric {
namespace {

constexpr int kRoom = 16;  ///< that filters need beyond their last pixel

/// Pixels [y0 - 1, y0 + kBlockSide + 1) of a column, empty beyond the picture.
using Window = std::array<CanvasPixel, kBlockSide + 2 + kRoom>;

void fetch(const Canvas& canvas, int x, int y0, Window& window) {
  window.fill(kEmptyPixel);
  if (x < canvas.x0 || x >= canvas.x0 + canvas.width) return;
  const int first = std::max(y0 - 1, 0), last = std::min(y0 + kBlockSide + 1, canvas.height);
  std::copy(canvas.column(x) + first, canvas.column(x) + last, window.begin() + (first - (y0 - 1)));
}

/// Colours of at most kBlockSide x kBlockSide pixels from (x0, y0) on, column by column.
using Colours = std::array<std::uint32_t, kBlockSide * kBlockSide + kRoom>;

void filterBlock(const Canvas& canvas, int x0, int columns, int y0, int rows, FilterPixels filter,
                 Colours& colours) {
  std::array<Window, kBlockSide + 2> windows;
  for (int i = 0; i < columns + 2; ++i) fetch(canvas, x0 + i - 1, y0, windows[std::size_t(i)]);
  for (int i = 0; i < columns; ++i) {
    const Window* const w = &windows[std::size_t(i)];
    filter(w[0].data(), w[1].data(), w[2].data(), rows, colours.data() + i * kBlockSide);
  }
}

}  // namespace

void develop(const Canvas& canvas, int x0, int x1, const std::vector<PixelSource>& sources,
             const Kernels& kernels, Frame& frame, FloatImage& inverseZDepth) {
  const std::vector<std::uint32_t> wide(sources.begin(), sources.end());
  Colours filtered{};
  CanvasBlock block;
  block.columnPitch = canvas.height;
  block.filtered = canvas.places ? filtered.data() : nullptr;
  block.sources = wide.data();
  block.depthBits = static_cast<std::uint32_t>(canvas.depthBits() >> 32);
  block.rowPitch = frame.colour.width;
  for (int left = x0; left < x1; left += kBlockSide)
    for (int top = 0; top < canvas.height; top += kBlockSide) {
      const int columns = std::min(kBlockSide, x1 - left), rows = std::min(kBlockSide, canvas.height - top);
      if (canvas.places) filterBlock(canvas, left, columns, top, rows, kernels.filter, filtered);
      block.pixels = canvas.column(left) + top;
      block.colour = reinterpret_cast<std::uint32_t*>(&frame.colour.at(left, top));
      block.source = &frame.source.at(left, top);
      block.inverseZDepth = &inverseZDepth.at(left, top);
      if (columns == kBlockSide && rows == kBlockSide)
        kernels.writeRows(block);
      else
        writeRowsOfPart(block, columns, rows);
    }
}

}  // namespace acentric
