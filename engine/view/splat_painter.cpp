#include "engine/view/splat_painter.h"

#include <algorithm>
#include <cmath>

#include "engine/image/colour.h"
#include "engine/view/walk_scene.h"

namespace acentric {
namespace {

/// What a pixel remembers of the sample last blended into it: slot, column, row, 20 bits of inverse distance,
/// and its place in the order in which its capture pixel's samples are drawn. Neighbouring splats of one pane
/// of glass overlap; without this the overlap would be tinted twice.
std::uint64_t stampOf(const PaintTarget& target, std::uint32_t index) {
  constexpr std::uint32_t kLastRank = 7;
  std::uint32_t rank = 0;
  while (rank < kLastRank && rank < index &&
         target.samples[index - rank - 1].row == target.samples[index].row)
    ++rank;
  const float inverseDistance = inverseDistanceOf(target.samples[index]);
  const std::uint32_t order = inverseDistance > target.footInverse ? rank : 2 * kLastRank + 1 - rank;
  const std::uint32_t depthBits = std::bit_cast<std::uint32_t>(inverseDistance) >> 8;
  return (std::uint64_t(target.slot) << 56) | (std::uint64_t(target.column) << 40) |
         (std::uint64_t(target.samples[index].row) << 24) | (depthBits & ~15u) | order;
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

/// A pixel and what was last blended into it.
struct BlendedPixel {
  CanvasPixel& pixel;
  std::uint64_t& stamp;
  std::uint32_t& blended;

  /// 0 where that is hidden now, or was never there.
  std::uint64_t validStamp() const { return blended == static_cast<std::uint32_t>(pixel) ? stamp : 0; }
};

/// False where nothing changes.
bool blendInto(const BlendedPixel& at, std::uint32_t colour, std::uint64_t newStamp) {
  CanvasPixel& pixel = at.pixel;
  const std::uint32_t slot = slotOf(pixel);
  if (slot == 0 || sameSurface(at.validStamp(), newStamp))
    return false;  // over a hole there is nothing to tint: it stays a hole
  const Rgba8 mixed = blendOver(colourOf(colour), colourOf(static_cast<std::uint32_t>(pixel) | 0xff000000u));
  pixel = (pixel & ~CanvasPixel(0xffffffff)) | (wordOf(mixed) & 0xffffffu) | (slot << 24);
  at.stamp = newStamp;
  at.blended = static_cast<std::uint32_t>(pixel);
  return true;
}

/// `kMarks`: the canvas is told which mirrors it shows. `kPlaces`: and where samples lie. `kBehind`: only
/// open pixels are painted.
template <PaintMode mode, bool kMarks, bool kPlaces, bool kBehind>
class Painter {
 public:
  explicit Painter(const PaintTarget& target)
      : target_(target),
        rect_(target.rect),
        height_(target.canvas->height),
        pixels_(target.canvas->pixels.data()),
        stamps_(target.canvas->stamps.data()),
        blended_(target.canvas->blended.data()),
        mirrors_(target.canvas->mirrors.data()) {}

  [[gnu::noinline]] std::uint64_t paint(const Splat* splats, int count, bool reversed,
                                        bool pixelByPixel) const {
    std::uint64_t painted = 0;
    // Are all pixels' samples drawn in the order of the rows, or does some pixel's foot lie between them?
    if (target_.range.x > target_.footInverse ? !reversed
                                              : reversed && target_.range.y <= target_.footInverse)
      pixelByPixel = false;
    const Splat* const end = splats + count;
    if (!pixelByPixel && reversed) {
      for (const Splat* s = end; s > splats;) painted += paint(*--s);
    } else if (!pixelByPixel) {
      for (const Splat* s = splats; s < end; ++s) painted += paint(*s);
    } else if (reversed) {
      for (const Splat *last = end, *first = end; last > splats; last = first) {
        for (--first; first > splats && rowOf(first[-1]) == rowOf(last[-1]);) --first;
        painted += paintPixel(first, last);
      }
    } else {
      for (const Splat *first = splats, *last = splats; first < end; first = last) {
        for (++last; last < end && rowOf(*last) == rowOf(*first);) ++last;
        painted += paintPixel(first, last);
      }
    }
    return painted;
  }

 private:
  static constexpr bool kOver = mode == PaintMode::over || mode == PaintMode::overBlended;
  static constexpr CanvasPixel kPlace = kPlaces ? kPlaceBits : 0;

  std::uint16_t rowOf(const Splat& splat) const { return target_.samples[splat.index].row; }

  /// Samples of one pixel, [first, last): those before the foot come nearer to the eye in stored order, those
  /// beyond it recede.
  [[gnu::always_inline]] std::uint64_t paintPixel(const Splat* first, const Splat* last) const {
    if (last - first == 1) return paint(*first);
    const Splat* const foot = std::partition_point(first, last, [&](const Splat& s) {
      return inverseDistanceOf(target_.samples[s.index]) > target_.footInverse;
    });
    std::uint64_t painted = 0;
    for (const Splat* s = first; s < foot; ++s) painted += paint(*s);
    for (const Splat* s = last; s > foot;) painted += paint(*--s);
    return painted;
  }

  /// Once, where its first pixel is.
  [[gnu::always_inline]] bool counts(const Splat& splat) const {
    const int first = std::max<int>(splat.x, 0);
    return first >= target_.countedFrom && first < target_.countedTo;
  }

  [[gnu::always_inline]] bool paint(const Splat& splat) const {
    const std::uint32_t colour = wordOf(target_.colour[splat.index]);
    const bool opaque = colour >= 0xff000000u;
    const bool wanted = kOver || mode == PaintMode::reflect || opaque == (mode == PaintMode::nearest);
    if (!wanted) return false;
    const CanvasPixel plain =
        canvasPixel((colour & 0xffffffu) | (target_.slot << 24), splat.inverseZDepth) & ~kPlace;
    std::uint8_t mirror = 0;
    if constexpr (kMarks) mirror = target_.mirror == nullptr ? std::uint8_t(0) : target_.mirror[splat.index];
    if constexpr (kOver || mode == PaintMode::reflect)
      if (splat.small && (mode != PaintMode::overBlended || opaque)) {
        const bool seen = paintSmall(splat, plain, mirror);
        return seen && counts(splat);
      }
    return paintAny(splat, plain, mirror, colour, opaque);
  }

  /// Its four corners, which are all its pixels, some of them twice: sizes of splats change from one to the
  /// next, and a branch on them would be foretold wrongly as often as not. Is its first pixel painted?
  [[gnu::always_inline]] bool paintSmall(const Splat& splat, CanvasPixel plain, std::uint8_t mirror) const {
    const std::ptrdiff_t down = splat.height - 1, right = (splat.width - 1) * height_,
                         at = (splat.x - rect_.x0) * height_ + splat.y;
    CanvasPixel* const pixels = pixels_ + at;
    [[maybe_unused]] std::uint8_t* const mirrors = mirrors_ + at;
    const auto paintCorner = [&](std::ptrdiff_t corner, int dx, int dy) {
      CanvasPixel& pixel = pixels[corner];
      CanvasPixel painted = plain;
      if constexpr (kPlaces) painted |= placeBits(splat.placeX - dx, splat.placeY - dy, splat.spread);
      bool open = true;
      if constexpr (kBehind) open = slotOf(pixel) < target_.openBelow;
      if constexpr (mode == PaintMode::reflect) {
        open = mirrors[corner] == mirror;
        painted = reflected(pixel, painted);
      }
      pixel = open ? painted : pixel;
      if constexpr (kMarks && kOver) mirrors[corner] = open ? mirror : mirrors[corner];
      return open;
    };
    const int dx = 8 * (splat.width - 1), dy = 8 * (splat.height - 1);
    const bool first = paintCorner(0, 0, 0);
    paintCorner(down, 0, dy);
    paintCorner(right, dx, 0);
    paintCorner(right + down, dx, dy);
    return first;
  }

  /// What a mirror's pixel becomes: it keeps the mirror's own depth.
  static CanvasPixel reflected(CanvasPixel mirror, CanvasPixel shown) {
    constexpr CanvasPixel kDepth = ~CanvasPixel(0xffffffff) & ~kPlace;
    return (mirror & kDepth) | (shown & ~kDepth);
  }

  [[gnu::noinline]] bool paintAny(const Splat& splat, CanvasPixel plain, std::uint8_t mirror,
                                  std::uint32_t colour, bool opaque) const {
    const int x0 = std::max<int>(splat.x, rect_.x0), x1 = std::min<int>(splat.x + splat.width, rect_.x1);
    const int y0 = std::max<int>(splat.y, rect_.y0), y1 = std::min<int>(splat.y + splat.height, rect_.y1);
    const float inverseZDepth = inverseZDepthOf(plain);
    const auto depthOf = [](CanvasPixel pixel) { return inverseZDepthOf(pixel & ~kPlace); };
    bool counted = counts(splat);
    if constexpr (kBehind)
      counted = counted && slotOf(pixels_[(x0 - rect_.x0) * height_ + y0]) < target_.openBelow;
    if constexpr (mode == PaintMode::reflect)
      counted = counted && y0 < y1 && mirrors_[(x0 - rect_.x0) * height_ + y0] == mirror;
    for (int x = x0; x < x1; ++x) {
      const std::ptrdiff_t start = (x - rect_.x0) * height_;
      CanvasPixel* const column = pixels_ + start;
      [[maybe_unused]] std::uint8_t* const mirrors = mirrors_ + start;
      const auto pixelAt = [&](int y) {
        if constexpr (!kPlaces) return plain;
        return plain |
               placeBits(splat.placeX - 8 * (x - splat.x), splat.placeY - 8 * (y - splat.y), splat.spread);
      };
      const auto each = [&](auto&& paintRow) {
        for (int y = y0; y < y1; ++y)
          if (!kBehind || slotOf(column[y]) < target_.openBelow) paintRow(y);
      };
      if constexpr (mode == PaintMode::over) {
        each([&](int y) {
          column[y] = pixelAt(y);
          if constexpr (kMarks) mirrors[y] = mirror;
        });
      } else if constexpr (mode == PaintMode::nearest) {
        each([&](int y) {
          if (!(inverseZDepth > depthOf(column[y]))) return;
          column[y] = pixelAt(y);
          if constexpr (kMarks) mirrors[y] = mirror;
        });
      } else if constexpr (mode == PaintMode::reflect) {
        each([&](int y) {
          if (mirrors[y] == mirror) column[y] = reflected(column[y], pixelAt(y));
        });
      } else {
        if (mode == PaintMode::overBlended && opaque) {
          each([&](int y) {
            column[y] = pixelAt(y);
            if constexpr (kMarks) mirrors[y] = mirror;
          });
          continue;
        }
        const std::uint64_t stamp = stampOf(target_, splat.index);
        each([&](int y) {
          if (mode != PaintMode::overBlended && !(inverseZDepth >= depthOf(column[y]))) return;
          const BlendedPixel at{column[y], stamps_[start + y], blended_[start + y]};
          if (kBehind && (at.validStamp() >> 56) >= target_.openBelow) return;  // tinted by what is in front
          const bool changed = blendInto(at, colour, stamp);
          // What tints a mirror would be lost under what the mirror shows.
          if constexpr (kMarks) mirrors[y] = changed ? std::uint8_t(0) : mirrors[y];
        });
      }
    }
    return counted;
  }

  const PaintTarget target_;
  const PixelRect rect_;
  const std::ptrdiff_t height_;
  CanvasPixel* const pixels_;
  std::uint64_t* const stamps_;
  std::uint32_t* const blended_;
  std::uint8_t* const mirrors_;
};

template <bool kMarks, bool kPlaces, bool kBehind>
std::uint64_t paintBy(const PaintTarget& target, PaintMode mode, const Splat* splats, int count,
                      bool reversed, bool pixelByPixel) {
  switch (mode) {
    case PaintMode::over:
      return Painter<PaintMode::over, kMarks, kPlaces, kBehind>(target).paint(splats, count, reversed,
                                                                              pixelByPixel);
    case PaintMode::overBlended:
      return Painter<PaintMode::overBlended, kMarks, kPlaces, kBehind>(target).paint(splats, count, reversed,
                                                                                     pixelByPixel);
    case PaintMode::nearest:
      return Painter<PaintMode::nearest, kMarks, kPlaces, kBehind>(target).paint(splats, count, reversed,
                                                                                 false);
    case PaintMode::blendOnNearest:
      return Painter<PaintMode::blendOnNearest, kMarks, kPlaces, kBehind>(target).paint(
          splats, count, reversed, pixelByPixel);
    case PaintMode::reflect:
      return Painter<PaintMode::reflect, true, kPlaces, false>(target).paint(splats, count, reversed,
                                                                             pixelByPixel);
  }
  return 0;
}

template <bool kMarks, bool kPlaces>
constexpr auto paintByPlace(bool behind) {
  return behind ? paintBy<kMarks, kPlaces, true> : paintBy<kMarks, kPlaces, false>;
}

}  // namespace

std::uint64_t paintSplats(const PaintTarget& target, PaintMode mode, const Splat* splats, int count,
                          bool reversed, bool pixelByPixel) {
  const Canvas& canvas = *target.canvas;
  const bool behind = target.openBelow > 0, marks = !canvas.mirrors.empty();
  const auto paint = canvas.places
                         ? marks ? paintByPlace<true, true>(behind) : paintByPlace<false, true>(behind)
                     : marks ? paintByPlace<true, false>(behind)
                             : paintByPlace<false, false>(behind);
  return paint(target, mode, splats, count, reversed, pixelByPixel);
}

}  // namespace acentric
