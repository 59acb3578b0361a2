#include "engine/view/develop.h"

#include <algorithm>
#include <array>

namespace acentric {
namespace {

constexpr int kRows = 32;  ///< of a block, one task each

/// Three columns of a block with the rows above and below it, going from left to right through the picture.
class Window {
 public:
  Window(const Canvas& canvas, int y0, int y1) : canvas_(canvas), y0_(y0), y1_(y1) {
    for (auto& column : columns_) column.fill(kEmptyPixel);
    fetch(0);
  }
  /// Columns x - 1, x, x + 1; called for each x in turn.
  void filter(int x, FilterPixels filterPixels, std::uint32_t* colour) {
    fetch(x + 1);
    filterPixels(at(x - 1).data(), at(x).data(), at(x + 1).data(), y1_ - y0_, colour);
  }

 private:
  using Column = std::array<CanvasPixel, kRows + 18>;
  Column& at(int x) { return columns_[std::size_t(x + 3) % columns_.size()]; }
  void fetch(int x) {
    Column& column = at(x);
    if (x >= canvas_.width) {
      column.fill(kEmptyPixel);
      return;
    }
    const int first = std::max(y0_ - 1, 0), last = std::min(y1_ + 1, canvas_.height);
    std::copy(canvas_.column(x) + first, canvas_.column(x) + last, column.begin() + (first - (y0_ - 1)));
  }

  const Canvas& canvas_;
  int y0_, y1_;
  std::array<Column, 3> columns_;
};

}  // namespace

void develop(const Canvas& canvas, const std::vector<PixelSource>& sources, FilterPixels filter, Frame& frame,
             FloatImage& inverseZDepth, TaskRunner& runner) {
  const CanvasPixel depthBits = ~(canvas.places ? kPlaceBits : CanvasPixel(0));
  const std::size_t blocks = static_cast<std::size_t>((canvas.height + kRows - 1) / kRows);
  runner.parallelFor(blocks, [&](std::size_t block) {
    const int y0 = static_cast<int>(block) * kRows, y1 = std::min(y0 + kRows, canvas.height);
    Window window(canvas, y0, y1);
    std::array<std::uint32_t, kRows + 16> filtered{};
    for (int x = 0; x < canvas.width; ++x) {
      const CanvasPixel* column = canvas.column(x);
      if (canvas.places) window.filter(x, filter, filtered.data());
      for (int y = y0; y < y1; ++y) {
        const CanvasPixel pixel = column[y];
        const std::uint32_t slot = slotOf(pixel);
        if (slot == 0) continue;
        frame.colour.at(x, y) = colourOf(canvas.places ? filtered[std::size_t(y - y0)]
                                                       : static_cast<std::uint32_t>(pixel) | 0xff000000u);
        frame.source.at(x, y) = sources[slot];
        inverseZDepth.at(x, y) = inverseZDepthOf(pixel & depthBits);
      }
    }
  });
}

}  // namespace acentric
