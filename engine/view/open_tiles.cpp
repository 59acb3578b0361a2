#include "engine/view/open_tiles.h"

#include <algorithm>
#include <cmath>

namespace acentric {

template <class Open>
void OpenTiles::sum(const Open& open) {
  std::vector<std::uint32_t> sums((columns_ + 1) * (rows_ + 1), 0);
  for (std::size_t i = 0; i < columns_; ++i) {
    const std::size_t before = i * (rows_ + 1), own = before + rows_ + 1;
    for (std::size_t j = 0; j < rows_; ++j)
      sums[own + j + 1] = sums[own + j] + sums[before + j + 1] - sums[before + j] + (open(i, j) ? 1u : 0u);
  }
  sums_ = std::move(sums);
}

PixelRect OpenTiles::tile(std::size_t i, std::size_t j) const {
  const int x0 = rect_.x0 + int(i) * kWidth, y0 = rect_.y0 + int(j) * kHeight;
  return {x0, y0, std::min(x0 + kWidth, rect_.x1), std::min(y0 + kHeight, rect_.y1)};
}

bool OpenTiles::isOpen(std::size_t i, std::size_t j) const {
  const std::size_t left = i * (rows_ + 1) + j, right = left + rows_ + 1;
  return sums_[right + 1] + sums_[left] != sums_[left + 1] + sums_[right];
}

OpenTiles::OpenTiles(const PixelRect& strip, const CoverImage* cover, int beside)
    : rect_(strip),
      columns_(std::size_t(strip.width() + kWidth - 1) / kWidth),
      rows_(std::size_t(strip.height() + kHeight - 1) / kHeight) {
  sum([&](std::size_t i, std::size_t j) {
    if (cover == nullptr) return true;
    const PixelRect t = tile(i, j);
    for (int y = std::max(t.y0 - beside, 0); y < std::min(t.y1 + beside, cover->height); ++y)
      for (int x = std::max(t.x0 - beside, 0); x < std::min(t.x1 + beside, cover->width); ++x)
        if (cover->at(x, y) == kUncovered) return true;
    return false;
  });
}

template <class Holds>
OpenTiles::OpenTiles(const OpenTiles& before, const Holds& holds)
    : rect_(before.rect_), columns_(before.columns_), rows_(before.rows_) {
  sum([&](std::size_t i, std::size_t j) {
    if (!before.isOpen(i, j)) return false;
    const PixelRect t = tile(i, j);
    for (int x = t.x0; x < t.x1; ++x)
      if (holds(x, t.y0, t.y1)) return true;
    return false;
  });
}

OpenTiles::OpenTiles(const OpenTiles& before, const Canvas& canvas, std::uint32_t openBelow)
    : OpenTiles(before, [&](int x, int first, int end) {
        const CanvasPixel* const column = canvas.column(x);
        unsigned found = 0;
        for (int y = first; y < end; ++y) found |= unsigned(slotOf(column[y]) < openBelow);
        return found != 0;
      }) {}

OpenTiles OpenTiles::withMirrors(const OpenTiles& before, const Canvas& canvas) {
  return OpenTiles(before, [&](int x, int first, int end) {
    const std::uint8_t* const column = canvas.mirrors.data() + canvas.indexOf(x);
    return std::any_of(column + first, column + end, [](std::uint8_t mirror) { return mirror != 0; });
  });
}

}  // namespace acentric
