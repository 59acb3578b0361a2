#include "engine/view/develop.h"

#include <algorithm>

namespace acentric {
void develop(const Canvas& canvas, int x0, int x1, const std::vector<PixelSource>& sources,
             const Kernels& kernels, Frame& frame, FloatImage& inverseZDepth) {
  const std::vector<std::uint32_t> wide(sources.begin(), sources.end());
  CanvasBlock block;
  block.columnPitch = canvas.height;
  block.sources = wide.data();
  block.rowPitch = frame.colour.width;
  for (int left = x0; left < x1; left += kBlockSide)
    for (int top = 0; top < canvas.height; top += kBlockSide) {
      const int columns = std::min(kBlockSide, x1 - left), rows = std::min(kBlockSide, canvas.height - top);
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
