#pragma once
/// Writes projected samples to the canvas.

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "engine/view/splats.h"

namespace acentric {

enum class PaintMode {
  over,            ///< opaque: what comes later lies on top
  overBlended,     ///< the same with blended samples among them
  nearest,         ///< opaque samples by depth test; blended ones are left out
  blendOnNearest,  ///< blended samples alone, in front of what `nearest` left
  reflect,         ///< opaque, onto the pixels of their own mirror, which keep its depth
};

/// Which samples the splats come from, and where they go.
struct PaintTarget {
  Canvas* canvas = nullptr;
  const Rgba8* colour = nullptr;  ///< Splat::index counts from here
  const PackedSample* samples = nullptr;
  const std::uint8_t* mirror = nullptr;  ///< null: of no mirror
  std::uint32_t slot = 0;                ///< 1..kMaxSlots
  std::uint32_t column = 0;              ///< of the capture
  float footInverse = 0;                 ///< RowOrder::footInverse
  glm::vec2 range{0, HUGE_VALF};         ///< least and largest inverse distance of the splats
  int countedFrom = 0, countedTo = 0;    ///< columns of the picture whose splats are counted
  /// If not 0, only pixels with lesser slots are painted: those that nothing in front has covered.
  std::uint32_t openBelow = 0;
};

/// One after the other, or last to first. `pixelByPixel` (layered captures): rows in that order too, but the
/// samples of each pixel by their distance from the eye (column_order.h). Returns how many were painted whose
/// first visible pixel lies in the columns that count and may be painted, so that canvases beside each other
/// add up. A canvas that has room for them is told the mirrors that its pixels show.
std::uint64_t paintSplats(const PaintTarget& target, PaintMode mode, std::span<const Splat> splats,
                          bool reversed, bool pixelByPixel);

}  // namespace acentric
