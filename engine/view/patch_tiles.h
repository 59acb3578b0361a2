#pragma once
/// The patches of a picture by tiles of it, for renderers that paint all pixels of a tile together.

#include <cstdint>
#include <span>
#include <vector>

#include "engine/view/patch_plan.h"

namespace acentric {

struct PatchTile {
  std::uint16_t x = 0, y = 0;        ///< its first pixel
  std::uint32_t first = 0, end = 0;  ///< of PatchTiles::patches
};

struct PatchTiles {
  static constexpr int kSide = 16;  ///< pixels; fewer at the right and lower border of the picture

  std::vector<PatchTile> tiles;        ///< those that any patch may touch, or all
  std::vector<std::uint32_t> patches;  ///< tile after tile, each in the order of the strips

  /// `patches` are numbered through the strips.
  void find(std::span<const StripDraw> strips, int width, int height, bool all = false);

 private:
  /// Tiles of one column of tiles that a patch may touch.
  struct Touch {
    std::uint32_t patch = 0;
    std::uint16_t column = 0, firstRow = 0, endRow = 0;
  };
  std::vector<Touch> touches_;
  std::vector<std::uint32_t> next_;  ///< by tile of the picture
  std::vector<RowRange> rows_;
};

}  // namespace acentric
