#pragma once
/// Where a strip of the canvas is still open: what lies behind need not be projected elsewhere.

#include <cstdint>
#include <vector>

#include "engine/view/canvas.h"
#include "engine/view/warp_kernel.h"

namespace acentric {

class OpenTiles {
 public:
  /// Pixels with slots below `openBelow` are open.
  OpenTiles(const Canvas& canvas, const PixelRect& rect, std::uint32_t openBelow);

  bool none() const { return sums_.back() == 0; }

  /// May a sample of these tangents and inverse distances, which the kernel puts on the picture with
  /// `column`, reach an open pixel with its splat?
  bool mayReach(const ProjectColumn& column, const TangentRange& tangents, const glm::vec2& range) const;

 private:
  static constexpr int kSide = 8;
  bool any(int x0, int y0, int x1, int y1) const;  ///< pixels [x0, x1) x [y0, y1), cut to the strip

  PixelRect rect_;
  std::size_t columns_, rows_;
  std::vector<std::uint32_t> sums_;  ///< open tiles left of and above each corner, column by column
};

}  // namespace acentric
