#pragma once
/// Where a strip of the canvas is still open: what cannot reach it need not be projected.

#include <cstdint>
#include <vector>

#include "engine/view/canvas.h"
#include "engine/view/warp_kernel.h"

namespace acentric {

/// By pixel of the picture, row by row: what covers it once all captures are drawn.
using CoverImage = Image<std::uint32_t>;
inline constexpr std::uint32_t kUncovered = 0xffffffff;

class OpenTiles {
 public:
  /// Open is what nothing covers; pixels that lie so many columns and rows beside an open one are read too
  /// and count as open. `cover` may be null: all is open.
  OpenTiles(const PixelRect& strip, const CoverImage* cover, int beside);
  /// Of what was open, that which holds pixels with slots below `openBelow`.
  OpenTiles(const OpenTiles& before, const Canvas& canvas, std::uint32_t openBelow);
  /// Of what was open, that which holds pixels that show mirrors.
  static OpenTiles withMirrors(const OpenTiles& before, const Canvas& canvas);

  bool none() const { return sums_.back() == 0; }
  bool all() const { return sums_.back() == columns_ * rows_; }

  /// Tells a block test of them.
  void tell(BlockTest& test) const {
    test.openTiles = sums_.data();
    test.tileColumns = std::int32_t(columns_), test.tileRows = std::int32_t(rows_);
  }

 private:
  static constexpr int kWidth = 1 << kTileWidthBits, kHeight = 1 << kTileHeightBits;
  bool isOpen(std::size_t i, std::size_t j) const;
  PixelRect tile(std::size_t i, std::size_t j) const;
  /// Of those that were open before the tiles with such pixels: `holds(x, firstY, endY)` of a column of one.
  template <class Holds>
  OpenTiles(const OpenTiles& before, const Holds& holds);
  /// `open(i, j)` of every tile; the tiles of one column follow each other.
  template <class Open>
  void sum(const Open& open);

  PixelRect rect_;
  std::size_t columns_, rows_;
  std::vector<std::uint32_t> sums_;  ///< open tiles left of and above each corner, column by column
};

}  // namespace acentric
