#pragma once
/// A patch of samples on a plane that faces the eye.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/view/display_patches.h"
#include "engine/view/patch_kernel.h"

namespace acentric::test {

/// A patch of columns x rows samples, one pixel of the picture each at `scale` 1, seen from where the capture
/// was taken: the picture's row y shows the patch's row y * scale + shift, at its column `column`.
class FlatPatch {
 public:
  FlatPatch(int columns, int rows) : columns_(columns), rows_(rows) {
    const auto texels = std::size_t(columns + 2) * std::size_t(rows + 2);
    cover_.assign(texels, 0);
    colour_.assign(texels, 0xff000000u | 64u | 64u << 8 | 64u << 16);
  }
  void set(int column, int row, std::uint32_t parts, std::uint32_t colour, std::uint32_t roles = 1) {
    const auto at = std::size_t(column + 1) * std::size_t(rows_ + 2) + std::size_t(row + 1);
    cover_[at] = parts | roles << kTexelRoles;
    colour_[at] = colour;
  }
  void setAll(std::uint32_t parts, std::uint32_t colour) {
    std::fill(colour_.begin(), colour_.end(), colour);  // of the border too
    for (int i = 0; i < columns_; ++i)
      for (int j = 0; j < rows_; ++j) set(i, j, parts, colour);
  }
  void markWhole() { markWholeBlocks(cover_.data(), columns_, rows_); }
  std::ptrdiff_t countOf(std::uint32_t mark) const {
    return std::ranges::count_if(cover_, [&](std::uint32_t word) { return (word & mark) != 0; });
  }
  PatchColumn column(double column, double scale, double shift) const {
    constexpr double kPitch = 0.001;  // radians: all is near the axis
    PatchColumn out{};
    out.start[0] = 1, out.start[1] = float(std::tan((column - 0.5 * columns_) * kPitch));
    out.start[2] = float(-((0.5 * scale + shift) - 0.5 * rows_) * kPitch);  // pixels' centres
    out.step[2] = float(-scale * kPitch);
    out.across[1] = float(scale * kPitch);
    out.depthStart = 0.25f;
    out.columnsPerRadian = out.rowsPerRadian = float(1 / kPitch);
    out.columnOffset = 0.5f * float(columns_), out.rowOffset = 0.5f * float(rows_);
    out.columns = columns_, out.rows = rows_;
    out.cover = cover_.data(), out.colour = colour_.data();
    out.wantedRoles = 1u << kTexelRoles;
    out.slot = 7;
    return out;
  }

 private:
  int columns_, rows_;
  std::vector<std::uint32_t> cover_, colour_;
};

}  // namespace acentric::test
