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
  const int x0 = rect_.x0 + int(i) * kSide, y0 = rect_.y0 + int(j) * kSide;
  return {x0, y0, std::min(x0 + kSide, rect_.x1), std::min(y0 + kSide, rect_.y1)};
}

bool OpenTiles::isOpen(std::size_t i, std::size_t j) const {
  const std::size_t left = i * (rows_ + 1) + j, right = left + rows_ + 1;
  return sums_[right + 1] + sums_[left] != sums_[left + 1] + sums_[right];
}

OpenTiles::OpenTiles(const PixelRect& strip, const CoverImage* cover, int beside)
    : rect_(strip),
      columns_(std::size_t(strip.width() + kSide - 1) / kSide),
      rows_(std::size_t(strip.height() + kSide - 1) / kSide) {
  sum([&](std::size_t i, std::size_t j) {
    if (cover == nullptr) return true;
    const PixelRect t = tile(i, j);
    for (int y = std::max(t.y0 - beside, 0); y < std::min(t.y1 + beside, cover->height); ++y)
      for (int x = std::max(t.x0 - beside, 0); x < std::min(t.x1 + beside, cover->width); ++x)
        if (cover->at(x, y) == kUncovered) return true;
    return false;
  });
}

OpenTiles::OpenTiles(const OpenTiles& before, const Canvas& canvas, std::uint32_t openBelow)
    : rect_(before.rect_), columns_(before.columns_), rows_(before.rows_) {
  sum([&](std::size_t i, std::size_t j) {
    if (!before.isOpen(i, j)) return false;
    const PixelRect t = tile(i, j);
    for (int x = t.x0; x < t.x1; ++x) {
      const CanvasPixel* const column = canvas.column(x);
      unsigned found = 0;
      for (int y = t.y0; y < t.y1; ++y) found |= unsigned(slotOf(column[y]) < openBelow);
      if (found != 0) return true;
    }
    return false;
  });
}

bool OpenTiles::any(int x0, int y0, int x1, int y1) const {
  x0 = std::max(x0, rect_.x0) - rect_.x0, x1 = std::min(x1, rect_.x1) - rect_.x0;
  y0 = std::max(y0, rect_.y0) - rect_.y0, y1 = std::min(y1, rect_.y1) - rect_.y0;
  if (x0 >= x1 || y0 >= y1) return false;
  const auto at = [&](int i, int j) { return sums_[std::size_t(i) * (rows_ + 1) + std::size_t(j)]; };
  const int i0 = x0 / kSide, j0 = y0 / kSide, i1 = (x1 - 1) / kSide + 1, j1 = (y1 - 1) / kSide + 1;
  return at(i1, j1) + at(i0, j0) != at(i0, j1) + at(i1, j0);
}

bool OpenTiles::mayReach(const ProjectColumn& c, const TangentRange& tangents, const glm::vec2& range) const {
  // Image positions are quotients of functions that are linear in tangent and inverse distance each, so the
  // corners are the extremes; of the size of squares too, but for a factor that grows away from the middle.
  double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL}, side = 1, off = 0;
  for (const double t : {tangents.low, tangents.high})
    for (const double w : {double(range.x), double(range.y)}) {
      const auto at = [&](int axis) { return c.a[axis] + t * c.z[axis] + w * c.b[axis]; };
      const double depth = at(2);
      if (!(depth > 1e-3 * (1 + std::abs(t)))) return true;  // beside or behind the eye
      const double place[2] = {at(0) / depth, at(1) / depth};
      for (int axis = 0; axis < 2; ++axis)
        low[axis] = std::min(low[axis], place[axis]), high[axis] = std::max(high[axis], place[axis]);
      side = std::max(side, std::sqrt(1 + t * t) / depth * double(c.footprint));
      const double offX = place[0] - double(c.centreX), offY = place[1] - double(c.centreY);
      off = std::max(off, offX * offX + offY * offY);
    }
  side *= std::sqrt(1 + off * double(c.inverseFocal) * double(c.inverseFocal));
  if (c.slanted || side > double(c.maxSide)) side = double(c.maxSide);
  const double margin = splatMargin(int(std::ceil(side)));
  const auto pixel = [](double place) { return int(std::clamp(std::floor(place), -1e6, 1e6)); };
  return any(pixel(low[0] - margin), pixel(low[1] - margin), pixel(high[0] + margin) + 1,
             pixel(high[1] + margin) + 1);
}

}  // namespace acentric
