#include <bit>

#include "engine/view/canvas_rows.h"

namespace acentric {

void writeRowsOfPart(const CanvasBlock& block, int columns, int rows) {
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const std::uint64_t pixel = block.pixels[x * block.columnPitch + y];
      const std::uint32_t own = static_cast<std::uint32_t>(pixel), slot = own >> 24;
      const std::ptrdiff_t at = y * block.rowPitch + x;
      block.colour[at] = slot > 0 ? own | 0xff000000u : own;
      block.source[at] = static_cast<std::uint16_t>(block.sources[slot]);
      block.inverseZDepth[at] =
          slot > 0 ? std::bit_cast<float>(static_cast<std::uint32_t>(pixel >> 32)) : 0.0f;
    }
}

void writeRowsScalar(const CanvasBlock& block) { writeRowsOfPart(block, kBlockSide, kBlockSide); }

}  // namespace acentric
