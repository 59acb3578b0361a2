#include "engine/view/splat_painter.h"

#include <algorithm>
#include <cmath>

#include "engine/image/colour.h"

namespace acentric {
namespace {

/// What a pixel remembers of the sample last blended into it: slot, column, row, 20 bits of inverse distance,
/// and its place in the order in which its capture pixel's samples are drawn. Neighbouring splats of one pane
/// of glass overlap; without this the overlap would be tinted twice.
std::uint64_t stampOf(const PaintTarget& target, std::uint32_t index) {
  constexpr std::uint32_t kLastRank = 7;
  std::uint32_t rank = 0;
  while (rank < kLastRank && rank < index && target.row[index - rank - 1] == target.row[index]) ++rank;
  const float inverseDistance = target.inverseDistance[index];
  const std::uint32_t order = inverseDistance > target.footInverse ? rank : 2 * kLastRank + 1 - rank;
  const std::uint32_t depthBits = std::bit_cast<std::uint32_t>(inverseDistance) >> 8;
  return (std::uint64_t(target.slot) << 56) | (std::uint64_t(target.column) << 40) |
         (std::uint64_t(target.row[index]) << 24) | (depthBits & ~15u) | order;
}

/// Is a sample with stamp `other` of a surface that the pixel was tinted by, `stamp` being the last of them?
bool sameSurface(std::uint64_t stamp, std::uint64_t other) {
  constexpr int kNeighbours = 2;
  // Two panes come as near to each other as one likes at a corner, so those that are drawn one after the
  // other differ by a hair already.
  constexpr float kRelativeStep = 0.06f, kStepToTheNext = 0.004f;
  if ((stamp >> 56) != (other >> 56)) return false;
  const auto apart = [&](int shift) {
    return std::abs(int((stamp >> shift) & 0xffff) - int((other >> shift) & 0xffff));
  };
  if (apart(40) > kNeighbours || apart(24) > kNeighbours) return false;
  if ((other & 15) < (stamp & 15)) return true;  // behind the last, which was drawn over the pixel's own
  const auto inverseDistance = [](std::uint64_t s) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(s & 0xfffff0) << 8);
  };
  const float a = inverseDistance(stamp), b = inverseDistance(other);
  const float step = (stamp & 15) == (other & 15) ? kRelativeStep : kStepToTheNext;
  return std::abs(a - b) <= step * std::max(a, b);
}

/// False where nothing changes.
bool blendInto(CanvasPixel& pixel, std::uint64_t& stamp, std::uint32_t colour, std::uint64_t newStamp) {
  const std::uint32_t slot = slotOf(pixel);
  if (slot == 0 || sameSurface(stamp, newStamp))
    return false;  // over a hole there is nothing to tint: it stays a hole
  const Rgba8 mixed = blendOver(colourOf(colour), colourOf(static_cast<std::uint32_t>(pixel) | 0xff000000u));
  pixel = (pixel & ~CanvasPixel(0xffffffff)) | (wordOf(mixed) & 0xffffffu) | (slot << 24);
  stamp = newStamp;
  return true;
}

/// Most splats are of one or two pixels a side and not cut by the rectangle.
constexpr int kSmallSide = 2;

bool isSmall(const PixelRect& rect, const Splat& splat) {
  return splat.width <= kSmallSide && splat.height <= kSmallSide && splat.x >= rect.x0 &&
         splat.y >= rect.y0 && splat.x + splat.width <= rect.x1 && splat.y + splat.height <= rect.y1;
}

/// The four corners of a small splat, which are all its pixels, some of them twice: sizes of splats change
/// from one to the next, and a branch on them would be foretold wrongly as often as not.
struct Corners {
  std::size_t first, below, right, across;

  Corners(const Canvas& canvas, const Splat& splat)
      : first(std::size_t(splat.x) * std::size_t(canvas.height) + std::size_t(splat.y)),
        below(first + splat.height - 1u),
        right(first + (splat.width - 1u) * std::size_t(canvas.height)),
        across(right + splat.height - 1u) {}
  template <class T>
  void fill(std::vector<T>& pixels, T value) const {
    T* const p = pixels.data();
    p[first] = p[below] = p[right] = p[across] = value;
  }
  void fillWithPlaces(std::vector<CanvasPixel>& pixels, CanvasPixel plain, const Splat& splat) const {
    const int x = splat.placeX, y = splat.placeY, dx = 8 * (splat.width - 1), dy = 8 * (splat.height - 1);
    CanvasPixel* const p = pixels.data();
    p[first] = plain | placeBits(x, y, splat.spread);
    p[below] = plain | placeBits(x, y - dy, splat.spread);
    p[right] = plain | placeBits(x - dx, y, splat.spread);
    p[across] = plain | placeBits(x - dx, y - dy, splat.spread);
  }
};

/// `kMarks`: the canvas is told which mirrors it shows. `kPlaces`: and where samples lie.
template <PaintMode mode, bool kMarks, bool kPlaces>
bool paintSplat(const PaintTarget& target, const Splat& splat) {
  Canvas& canvas = *target.canvas;
  const PixelRect& rect = target.rect;
  const int x0 = std::max<int>(splat.x, rect.x0), x1 = std::min<int>(splat.x + splat.width, rect.x1);
  const int y0 = std::max<int>(splat.y, rect.y0), y1 = std::min<int>(splat.y + splat.height, rect.y1);
  const std::uint32_t colour = wordOf(target.colour[splat.index]);
  const bool opaque = colour >= 0xff000000u;
  const bool wanted = mode == PaintMode::over || mode == PaintMode::overBlended ||
                      mode == PaintMode::reflect || opaque == (mode == PaintMode::nearest);
  if (!wanted) return false;
  constexpr CanvasPixel kPlace = kPlaces ? kPlaceBits : 0;
  const CanvasPixel plain =
      canvasPixel((colour & 0xffffffu) | (target.slot << 24), splat.inverseZDepth) & ~kPlace;
  const float inverseZDepth = inverseZDepthOf(plain);
  std::uint8_t mirror = 0;
  if constexpr (kMarks) mirror = target.mirror == nullptr ? std::uint8_t(0) : target.mirror[splat.index];
  if constexpr (mode == PaintMode::over || mode == PaintMode::overBlended)
    if (isSmall(rect, splat) && (mode == PaintMode::over || opaque)) {
      const Corners corners(canvas, splat);
      if constexpr (kPlaces)
        corners.fillWithPlaces(canvas.pixels, plain, splat);
      else
        corners.fill(canvas.pixels, plain);
      if constexpr (mode == PaintMode::overBlended) corners.fill(canvas.stamps, std::uint64_t(0));
      if constexpr (kMarks) corners.fill(canvas.mirrors, mirror);
      return true;
    }
  for (int x = x0; x < x1; ++x) {
    CanvasPixel* column = canvas.column(x);
    const auto pixelAt = [&](int y) {
      if constexpr (!kPlaces) return plain;
      return plain |
             placeBits(splat.placeX - 8 * (x - splat.x), splat.placeY - 8 * (y - splat.y), splat.spread);
    };
    std::uint8_t* mirrors = nullptr;
    if constexpr (kMarks) mirrors = canvas.mirrorColumn(x);
    if constexpr (mode == PaintMode::over) {
      for (int y = y0; y < y1; ++y) column[y] = pixelAt(y);
      if constexpr (kMarks) std::fill(mirrors + y0, mirrors + y1, mirror);
    } else if constexpr (mode == PaintMode::nearest) {
      for (int y = y0; y < y1; ++y)
        if (inverseZDepth > inverseZDepthOf(column[y] & ~kPlace)) {
          column[y] = pixelAt(y);
          if constexpr (kMarks) mirrors[y] = mirror;
        }
    } else if constexpr (mode == PaintMode::reflect) {
      constexpr CanvasPixel kDepth = ~CanvasPixel(0xffffffff) & ~kPlace;
      for (int y = y0; y < y1; ++y)
        if (mirrors[y] == mirror) column[y] = (column[y] & kDepth) | (pixelAt(y) & ~kDepth);
    } else {
      std::uint64_t* stamps = canvas.stampColumn(x);
      if (mode == PaintMode::overBlended && opaque) {
        for (int y = y0; y < y1; ++y) column[y] = pixelAt(y);
        std::fill(stamps + y0, stamps + y1, 0);  // what was blended here is hidden now
        if constexpr (kMarks) std::fill(mirrors + y0, mirrors + y1, mirror);
        continue;
      }
      const std::uint64_t stamp = stampOf(target, splat.index);
      for (int y = y0; y < y1; ++y)
        if (mode == PaintMode::overBlended || inverseZDepth >= inverseZDepthOf(column[y] & ~kPlace)) {
          const bool changed = blendInto(column[y], stamps[y], colour, stamp);
          // What tints a mirror would be lost under what the mirror shows.
          if constexpr (kMarks) mirrors[y] = changed ? std::uint8_t(0) : mirrors[y];
        }
    }
  }
  return std::max<int>(splat.y, 0) >= rect.y0;
}

/// Samples of one pixel, [first, last): those before the foot come nearer to the eye in stored order, those
/// beyond it recede.
template <PaintMode mode, bool kMarks, bool kPlaces>
std::uint64_t paintPixel(const PaintTarget& target, const Splat* first, const Splat* last) {
  const Splat* foot = std::partition_point(
      first, last, [&](const Splat& s) { return target.inverseDistance[s.index] > target.footInverse; });
  std::uint64_t painted = 0;
  for (const Splat* s = first; s < foot; ++s) painted += paintSplat<mode, kMarks, kPlaces>(target, *s);
  for (const Splat* s = last; s > foot;) painted += paintSplat<mode, kMarks, kPlaces>(target, *--s);
  return painted;
}

template <PaintMode mode, bool kMarks, bool kPlaces>
std::uint64_t paintAll(const PaintTarget& target, const Splat* splats, int count, bool reversed,
                       bool pixelByPixel) {
  std::uint64_t painted = 0;
  const Splat* end = splats + count;
  if (!pixelByPixel) {
    if (reversed)
      while (end > splats) painted += paintSplat<mode, kMarks, kPlaces>(target, *--end);
    else
      for (const Splat* s = splats; s < end; ++s) painted += paintSplat<mode, kMarks, kPlaces>(target, *s);
    return painted;
  }
  const auto rowOf = [&](const Splat* s) { return target.row[s->index]; };
  if (reversed) {
    while (end > splats) {
      const Splat* first = end - 1;
      while (first > splats && rowOf(first - 1) == rowOf(end - 1)) --first;
      painted += paintPixel<mode, kMarks, kPlaces>(target, first, end);
      end = first;
    }
    return painted;
  }
  for (const Splat* first = splats; first < end;) {
    const Splat* last = first + 1;
    while (last < end && rowOf(last) == rowOf(first)) ++last;
    painted += paintPixel<mode, kMarks, kPlaces>(target, first, last);
    first = last;
  }
  return painted;
}

template <bool kMarks, bool kPlaces>
std::uint64_t paintBy(const PaintTarget& target, PaintMode mode, const Splat* splats, int count,
                      bool reversed, bool pixelByPixel) {
  switch (mode) {
    case PaintMode::over:
      return paintAll<PaintMode::over, kMarks, kPlaces>(target, splats, count, reversed, pixelByPixel);
    case PaintMode::overBlended:
      return paintAll<PaintMode::overBlended, kMarks, kPlaces>(target, splats, count, reversed, pixelByPixel);
    case PaintMode::nearest:
      return paintAll<PaintMode::nearest, kMarks, kPlaces>(target, splats, count, reversed, false);
    case PaintMode::blendOnNearest:
      return paintAll<PaintMode::blendOnNearest, kMarks, kPlaces>(target, splats, count, reversed,
                                                                  pixelByPixel);
    case PaintMode::reflect:
      return paintAll<PaintMode::reflect, true, kPlaces>(target, splats, count, reversed, pixelByPixel);
  }
  return 0;
}

}  // namespace

std::uint64_t paintSplats(const PaintTarget& target, PaintMode mode, const Splat* splats, int count,
                          bool reversed, bool pixelByPixel) {
  const Canvas& canvas = *target.canvas;
  const auto paint = canvas.places ? canvas.mirrors.empty() ? paintBy<false, true> : paintBy<true, true>
                     : canvas.mirrors.empty() ? paintBy<false, false>
                                              : paintBy<true, false>;
  return paint(target, mode, splats, count, reversed, pixelByPixel);
}

}  // namespace acentric
