#include "engine/view/splat_painter.h"

#include <algorithm>
#include <cmath>

#include "engine/image/colour.h"

namespace acentric {
namespace {

/// What a pixel remembers of the sample last blended into it. Neighbouring splats of one pane of glass
/// overlap; without this the overlap would be tinted twice.
std::uint64_t stampOf(const PaintTarget& target, std::uint32_t index) {
  const std::uint32_t depthBits = std::bit_cast<std::uint32_t>(target.inverseDistance[index]) >> 8;
  return (std::uint64_t(target.slot) << 56) | (std::uint64_t(target.column) << 40) |
         (std::uint64_t(target.row[index]) << 24) | depthBits;
}

bool sameSurface(std::uint64_t stamp, std::uint64_t other) {
  constexpr int kNeighbours = 2;
  constexpr float kRelativeStep = 0.06f;
  if ((stamp >> 56) != (other >> 56)) return false;
  const auto apart = [&](int shift) {
    return std::abs(int((stamp >> shift) & 0xffff) - int((other >> shift) & 0xffff));
  };
  if (apart(40) > kNeighbours || apart(24) > kNeighbours) return false;
  const auto inverseDistance = [](std::uint64_t s) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(s & 0xffffff) << 8);
  };
  const float a = inverseDistance(stamp), b = inverseDistance(other);
  return std::abs(a - b) <= kRelativeStep * std::max(a, b);
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

/// `kMarks`: the canvas is told which mirrors it shows.
template <PaintMode mode, bool kMarks>
bool paintSplat(const PaintTarget& target, const Splat& splat) {
  Canvas& canvas = *target.canvas;
  const PixelRect& rect = target.rect;
  const int x0 = std::max<int>(splat.x, rect.x0), x1 = std::min<int>(splat.x + splat.side, rect.x1);
  const int y0 = std::max<int>(splat.y, rect.y0), y1 = std::min<int>(splat.y + splat.side, rect.y1);
  const std::uint32_t colour = wordOf(target.colour[splat.index]);
  const bool opaque = colour >= 0xff000000u;
  const bool wanted = mode == PaintMode::over || mode == PaintMode::overBlended ||
                      mode == PaintMode::reflect || opaque == (mode == PaintMode::nearest);
  if (!wanted) return false;
  const CanvasPixel pixel = canvasPixel((colour & 0xffffffu) | (target.slot << 24), splat.inverseZDepth);
  std::uint8_t mirror = 0;
  if constexpr (kMarks) mirror = target.mirror == nullptr ? std::uint8_t(0) : target.mirror[splat.index];
  for (int x = x0; x < x1; ++x) {
    CanvasPixel* column = canvas.column(x);
    std::uint8_t* mirrors = nullptr;
    if constexpr (kMarks) mirrors = canvas.mirrorColumn(x);
    if constexpr (mode == PaintMode::over) {
      for (int y = y0; y < y1; ++y) column[y] = pixel;
      if constexpr (kMarks) std::fill(mirrors + y0, mirrors + y1, mirror);
    } else if constexpr (mode == PaintMode::nearest) {
      for (int y = y0; y < y1; ++y)
        if (splat.inverseZDepth > inverseZDepthOf(column[y])) {
          column[y] = pixel;
          if constexpr (kMarks) mirrors[y] = mirror;
        }
    } else if constexpr (mode == PaintMode::reflect) {
      constexpr CanvasPixel kDepth = ~CanvasPixel(0xffffffff);
      for (int y = y0; y < y1; ++y)
        if (mirrors[y] == mirror) column[y] = (column[y] & kDepth) | (pixel & ~kDepth);
    } else {
      std::uint64_t* stamps = canvas.stampColumn(x);
      if (mode == PaintMode::overBlended && opaque) {
        std::fill(column + y0, column + y1, pixel);
        std::fill(stamps + y0, stamps + y1, 0);  // what was blended here is hidden now
        if constexpr (kMarks) std::fill(mirrors + y0, mirrors + y1, mirror);
        continue;
      }
      const std::uint64_t stamp = stampOf(target, splat.index);
      for (int y = y0; y < y1; ++y)
        if (mode == PaintMode::overBlended || splat.inverseZDepth >= inverseZDepthOf(column[y])) {
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
template <PaintMode mode, bool kMarks>
std::uint64_t paintPixel(const PaintTarget& target, const Splat* first, const Splat* last) {
  const Splat* foot = std::partition_point(
      first, last, [&](const Splat& s) { return target.inverseDistance[s.index] > target.footInverse; });
  std::uint64_t painted = 0;
  for (const Splat* s = first; s < foot; ++s) painted += paintSplat<mode, kMarks>(target, *s);
  for (const Splat* s = last; s > foot;) painted += paintSplat<mode, kMarks>(target, *--s);
  return painted;
}

template <PaintMode mode, bool kMarks>
std::uint64_t paintAll(const PaintTarget& target, const Splat* splats, int count, bool reversed,
                       bool pixelByPixel) {
  std::uint64_t painted = 0;
  const Splat* end = splats + count;
  if (!pixelByPixel) {
    if (reversed)
      while (end > splats) painted += paintSplat<mode, kMarks>(target, *--end);
    else
      for (const Splat* s = splats; s < end; ++s) painted += paintSplat<mode, kMarks>(target, *s);
    return painted;
  }
  const auto rowOf = [&](const Splat* s) { return target.row[s->index]; };
  if (reversed) {
    while (end > splats) {
      const Splat* first = end - 1;
      while (first > splats && rowOf(first - 1) == rowOf(end - 1)) --first;
      painted += paintPixel<mode, kMarks>(target, first, end);
      end = first;
    }
    return painted;
  }
  for (const Splat* first = splats; first < end;) {
    const Splat* last = first + 1;
    while (last < end && rowOf(last) == rowOf(first)) ++last;
    painted += paintPixel<mode, kMarks>(target, first, last);
    first = last;
  }
  return painted;
}

template <bool kMarks>
std::uint64_t paintBy(const PaintTarget& target, PaintMode mode, const Splat* splats, int count,
                      bool reversed, bool pixelByPixel) {
  switch (mode) {
    case PaintMode::over:
      return paintAll<PaintMode::over, kMarks>(target, splats, count, reversed, pixelByPixel);
    case PaintMode::overBlended:
      return paintAll<PaintMode::overBlended, kMarks>(target, splats, count, reversed, pixelByPixel);
    case PaintMode::nearest:
      return paintAll<PaintMode::nearest, kMarks>(target, splats, count, reversed, false);
    case PaintMode::blendOnNearest:
      return paintAll<PaintMode::blendOnNearest, kMarks>(target, splats, count, reversed, pixelByPixel);
    case PaintMode::reflect:
      return paintAll<PaintMode::reflect, true>(target, splats, count, reversed, pixelByPixel);
  }
  return 0;
}

}  // namespace

std::uint64_t paintSplats(const PaintTarget& target, PaintMode mode, const Splat* splats, int count,
                          bool reversed, bool pixelByPixel) {
  const auto paint = target.canvas->mirrors.empty() ? paintBy<false> : paintBy<true>;
  return paint(target, mode, splats, count, reversed, pixelByPixel);
}

}  // namespace acentric
