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

void blendInto(const BlendedPixel& at, std::uint32_t colour, std::uint64_t newStamp) {
  CanvasPixel& pixel = at.pixel;
  const std::uint32_t slot = slotOf(pixel);
  if (slot == 0 || sameSurface(at.validStamp(), newStamp))
    return;  // over a hole there is nothing to tint: it stays a hole
  const Rgba8 mixed = blendOver(colourOf(colour), colourOf(static_cast<std::uint32_t>(pixel) | 0xff000000u));
  pixel = (pixel & ~CanvasPixel(0xffffffff)) | (wordOf(mixed) & 0xffffffu) | (slot << 24);
  at.stamp = newStamp;
  at.blended = static_cast<std::uint32_t>(pixel);
}

/// `kMarks`: samples may be of mirrors, which the canvas is told. `kBehind`: only open pixels are painted.
template <PaintMode mode, bool kMarks, bool kBehind>
class Painter {
 public:
  Painter(const PaintTarget& target, const SplatArrays& splats)
      : target_(target),
        splats_(splats),
        rect_(target.canvas->rect()),
        height_(target.canvas->height),
        pixels_(target.canvas->pixels.data()),
        stamps_(target.canvas->stamps.data()),
        blended_(target.canvas->blended.data()),
        mirrors_(target.canvas->mirrors.data()),
        mirrorPixels_(target.canvas->mirrorPixels.data()) {}

  [[gnu::noinline]] std::uint64_t paint(int begin, int end, bool reversed, bool pixelByPixel) const {
    std::uint64_t painted = 0;
    // Are all pixels' samples drawn in the order of the rows, or does some pixel's foot lie between them?
    if (target_.range.x > target_.footInverse ? !reversed
                                              : reversed && target_.range.y <= target_.footInverse)
      pixelByPixel = false;
    if (!pixelByPixel && reversed) {
      for (int i = end; i > begin;) painted += paint(--i);
    } else if (!pixelByPixel) {
      for (int i = begin; i < end; ++i) painted += paint(i);
    } else if (reversed) {
      for (int last = end, first = end; last > begin; last = first) {
        for (--first; first > begin && rowOf(first - 1) == rowOf(last - 1);) --first;
        painted += paintPixel(first, last);
      }
    } else {
      for (int first = begin, last = begin; first < end; first = last) {
        for (++last; last < end && rowOf(last) == rowOf(first);) ++last;
        painted += paintPixel(first, last);
      }
    }
    return painted;
  }

 private:
  static constexpr bool kOver = mode == PaintMode::over || mode == PaintMode::overBlended;

  std::uint32_t rowOf(int i) const { return target_.samples[splats_.indices[i]].row; }

  /// Samples of one pixel, [first, last): those before the foot come nearer to the eye in stored order, those
  /// beyond it recede.
  [[gnu::always_inline]] std::uint64_t paintPixel(int first, int last) const {
    if (last - first == 1) return paint(first);
    int foot = first;
    while (foot < last && inverseDistanceOf(target_.samples[splats_.indices[foot]]) > target_.footInverse)
      ++foot;
    std::uint64_t painted = 0;
    for (int i = first; i < foot; ++i) painted += paint(i);
    for (int i = last; i > foot;) painted += paint(--i);
    return painted;
  }

  /// Once, where its first pixel is.
  [[gnu::always_inline]] bool counts(int x) const {
    const int first = std::max(x, 0);
    return first >= target_.countedFrom && first < target_.countedTo;
  }

  std::uint8_t mirrorOf(int i) const { return kMarks ? target_.mirror[splats_.indices[i]] : std::uint8_t(0); }

  [[gnu::always_inline]] bool paint(int i) const {
    const std::uint32_t steps = splats_.steps[i];
    if (const std::uint8_t mirror = mirrorOf(i); steps != 0 && (mirror == 0 || mode == PaintMode::reflect))
        [[likely]] {
      if constexpr (mode == PaintMode::blendOnNearest) return false;
      return paintCorners(splats_.pixels[i], splats_.firsts[i], steps, mirror) &&
             counts(columnOf(splats_, i));
    }
    return paintAny(i);
  }

  /// The four corners, which are all pixels of such a splat, some of them twice: sizes of splats change from
  /// one to the next, and a branch on them would be foretold wrongly as often as not. Is its first pixel
  /// painted?
  [[gnu::always_inline]] bool paintCorners(CanvasPixel pixel, std::uint32_t first, std::uint32_t steps,
                                           std::uint8_t mirror) const {
    const std::ptrdiff_t right = steps & 0xffffu, down = steps >> 16 & 1u;
    const bool seen = paintOne(first, pixel, mirror);
    paintOne(first + down, pixel, mirror);
    paintOne(first + right, pixel, mirror);
    paintOne(first + right + down, pixel, mirror);
    return seen;
  }

  /// A pixel of the canvas, without a branch. Is it one of those that may be painted?
  [[gnu::always_inline]] bool paintOne(std::ptrdiff_t at, CanvasPixel painted, std::uint8_t mirror) const {
    CanvasPixel& pixel = pixels_[at];
    bool open = true;
    if constexpr (kBehind) open = slotOf(pixel) < target_.openBelow;
    if constexpr (mode == PaintMode::reflect) {
      open = mirrors_[at] == mirror;
      painted = reflected(pixel, painted);
    }
    const bool inFront = mode != PaintMode::nearest || inverseZDepthOf(painted) > inverseZDepthOf(pixel);
    pixel = open && inFront ? painted : pixel;
    return open;
  }

  /// What a mirror's pixel becomes: it keeps the mirror's own depth.
  static CanvasPixel reflected(CanvasPixel mirror, CanvasPixel shown) {
    constexpr CanvasPixel kDepth = ~CanvasPixel(0xffffffff);
    return (mirror & kDepth) | (shown & ~kDepth);
  }

  [[gnu::noinline]] bool paintAny(int i) const {
    const Splat splat = splatAt(splats_, i);
    const std::uint32_t colour = wordOf(target_.colour[splat.index]);
    const bool opaque = colour >= 0xff000000u;
    const bool wanted = kOver || opaque == (mode == PaintMode::nearest || mode == PaintMode::reflect);
    if (!wanted) return false;
    const std::uint8_t mirror = mirrorOf(i);
    const int x0 = std::max(splat.x, rect_.x0), x1 = std::min(splat.x + splat.side, rect_.x1);
    const int y0 = std::max(splat.y, rect_.y0), y1 = std::min(splat.y + splat.side, rect_.y1);
    bool counted = counts(splat.x);
    if constexpr (kBehind)
      counted = counted && slotOf(pixels_[(x0 - rect_.x0) * height_ + y0]) < target_.openBelow;
    if constexpr (mode == PaintMode::reflect)
      counted = counted && y0 < y1 && mirrors_[(x0 - rect_.x0) * height_ + y0] == mirror;
    const bool tints = mode == PaintMode::blendOnNearest || (mode == PaintMode::overBlended && !opaque);
    const std::uint64_t stamp = tints ? stampOf(target_, splat.index) : 0;
    for (int x = x0; x < x1; ++x)
      for (int y = y0; y < y1; ++y) {
        const std::ptrdiff_t at = (x - rect_.x0) * height_ + y;
        if (kBehind && slotOf(pixels_[at]) >= target_.openBelow) continue;
        if (tints) {
          tint(at, splat.pixel, colour, stamp);
          continue;
        }
        paintOne(at, splat.pixel, mirror);
        if (mirror != 0 && mode != PaintMode::reflect && pixels_[at] == splat.pixel)
          mirrors_[at] = mirror, mirrorPixels_[at] = splat.pixel;
      }
    return counted;
  }

  /// Of a sample that is not opaque.
  void tint(std::ptrdiff_t at, CanvasPixel plain, std::uint32_t colour, std::uint64_t stamp) const {
    if (mode != PaintMode::overBlended && !(inverseZDepthOf(plain) >= inverseZDepthOf(pixels_[at]))) return;
    const BlendedPixel pixel{pixels_[at], stamps_[at], blended_[at]};
    if (kBehind && (pixel.validStamp() >> 56) >= target_.openBelow) return;  // tinted by what is in front
    blendInto(pixel, colour, stamp);
  }

  const PaintTarget target_;
  const SplatArrays splats_;
  const PixelRect rect_;
  const std::ptrdiff_t height_;
  CanvasPixel* const pixels_;
  std::uint64_t* const stamps_;
  std::uint32_t* const blended_;
  std::uint8_t* const mirrors_;
  CanvasPixel* const mirrorPixels_;
};

template <bool kMarks, bool kBehind>
std::uint64_t paintBy(const PaintTarget& target, PaintMode mode, const SplatArrays& splats, int first,
                      int end, bool reversed, bool pixelByPixel) {
  const auto paint = [&](auto painter) { return painter.paint(first, end, reversed, pixelByPixel); };
  switch (mode) {
    case PaintMode::over:
      return paint(Painter<PaintMode::over, kMarks, kBehind>(target, splats));
    case PaintMode::overBlended:
      return paint(Painter<PaintMode::overBlended, kMarks, kBehind>(target, splats));
    case PaintMode::nearest:
      pixelByPixel = false;
      return paint(Painter<PaintMode::nearest, kMarks, kBehind>(target, splats));
    case PaintMode::blendOnNearest:
      return paint(Painter<PaintMode::blendOnNearest, kMarks, kBehind>(target, splats));
    case PaintMode::reflect:
      return paint(Painter<PaintMode::reflect, true, false>(target, splats));
  }
  return 0;
}

}  // namespace

std::uint64_t paintSplats(const PaintTarget& target, PaintMode mode, const SplatArrays& splats, int first,
                          int end, bool reversed, bool pixelByPixel) {
  const Canvas& canvas = *target.canvas;
  const bool behind = target.openBelow > 0, marks = !canvas.mirrors.empty() && target.mirror != nullptr;
  const auto paint = marks ? (behind ? paintBy<true, true> : paintBy<true, false>)
                           : (behind ? paintBy<false, true> : paintBy<false, false>);
  return paint(target, mode, splats, first, end, reversed, pixelByPixel);
}

}  // namespace acentric
