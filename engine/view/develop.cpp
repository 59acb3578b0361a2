#include "engine/view/develop.h"

#include <algorithm>

namespace acentric {

void develop(const Canvas& canvas, int x0, int x1, const std::vector<PixelSource>& sources, Frame& frame,
             FloatImage& inverseZDepth) {
  constexpr int kBlock = 16;  // from columns to rows: as much as the nearest cache holds
  for (int left = x0; left < x1; left += kBlock)
    for (int top = 0; top < canvas.height; top += kBlock)
      for (int y = top; y < std::min(top + kBlock, canvas.height); ++y)
        for (int x = left; x < std::min(left + kBlock, x1); ++x) {
          const CanvasPixel pixel = canvas.column(x)[y];
          const std::uint32_t slot = slotOf(pixel), own = static_cast<std::uint32_t>(pixel);
          frame.colour.at(x, y) = colourOf(slot > 0 ? own | 0xff000000u : own);
          frame.source.at(x, y) = sources[slot];
          inverseZDepth.at(x, y) = slot > 0 ? inverseZDepthOf(pixel) : 0.0f;
        }
}

}  // namespace acentric
