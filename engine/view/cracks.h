#pragma once
/// Cracks in a canvas: where the samples of a surface do not reach each other, as in the flutes of a column
/// that a camera sees at a slant, what lies behind shows between them. The cameras of the second cover look
/// from the other side and may have the surface there.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/view/canvas.h"

namespace acentric {

class Cracks {
 public:
  /// Pixels to either side of a crack at most, to its nearer borders.
  static constexpr int kReach = 3;
  /// Of inverse depth: what is nearer by this factor lies before.
  static constexpr float kBefore = 1.03f;

  /// Makes holes of the pixels with slots not below `openBelow` that have nearer ones on both sides, left and
  /// right or above and below, so that others are painted there; their depth stays. Pixels depend on those up
  /// to kReach beside them.
  void open(Canvas& canvas, std::uint32_t openBelow);
  /// Gives them back what they were, where nothing nearer was painted since.
  void close(Canvas& canvas);

 private:
  struct Crack {
    std::size_t at = 0;
    CanvasPixel pixel = 0;  ///< as it was
  };
  std::vector<Crack> cracks_;
};

}  // namespace acentric
