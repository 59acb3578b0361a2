#include "engine/view/patch_tiles.h"

#include <algorithm>

namespace acentric {

void PatchTiles::find(std::span<const StripDraw> strips, int width, int height, bool all) {
  const int across = (width + kSide - 1) / kSide, down = (height + kSide - 1) / kSide;
  touches_.clear();
  next_.assign(std::size_t(across) * std::size_t(down) + 1, 0);
  const auto tileAt = [&](int column, int row) {
    return std::size_t(row) * std::size_t(across) + std::size_t(column);
  };
  std::uint32_t patch = 0;
  for (const StripDraw& strip : strips)
    for (const PatchDraw& draw : strip.patches) {
      const PolygonRows& polygon = draw.polygon;
      polygon.rows(polygon.x0(), polygon.x1(), rows_);
      for (int column = polygon.x0() / kSide; column * kSide < polygon.x1(); ++column) {
        RowRange rows{height, 0};
        const int end = std::min((column + 1) * kSide, polygon.x1());
        for (int x = std::max(column * kSide, polygon.x0()); x < end; ++x) {
          const RowRange& own = rows_[std::size_t(x - polygon.x0())];
          if (own.first >= own.end) continue;
          rows.first = std::min(rows.first, own.first), rows.end = std::max(rows.end, own.end);
        }
        if (rows.first >= rows.end) continue;
        const int firstRow = rows.first / kSide, endRow = (rows.end - 1) / kSide + 1;
        touches_.push_back({patch, std::uint16_t(column), std::uint16_t(firstRow), std::uint16_t(endRow)});
        for (int row = firstRow; row < endRow; ++row) ++next_[tileAt(column, row) + 1];
      }
      ++patch;
    }
  tiles.clear();
  for (std::size_t tile = 0; tile + 1 < next_.size(); ++tile) {
    const std::uint32_t first = next_[tile], end = next_[tile + 1] += first;
    if (first == end && !all) continue;
    tiles.push_back({std::uint16_t(tile % std::size_t(across) * kSide),
                     std::uint16_t(tile / std::size_t(across) * kSide), first, end});
  }
  patches.resize(next_.back());
  for (const Touch& touch : touches_)
    for (int row = touch.firstRow; row < touch.endRow; ++row)
      patches[next_[tileAt(touch.column, row)]++] = touch.patch;
}

}  // namespace acentric
