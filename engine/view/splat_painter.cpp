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

class Painter {
 public:
  Painter(const PaintTarget& target, PaintMode mode, std::span<const Splat> splats)
      : target_(target),
        mode_(mode),
        splats_(splats),
        canvas_(*target.canvas),
        rect_(canvas_.rect()),
        marks_(!canvas_.mirrors.empty() && (target.mirror != nullptr || mode == PaintMode::reflect)) {}

  std::uint64_t paint(bool reversed, bool pixelByPixel) const {
    std::uint64_t painted = 0;
    // Are all pixels' samples drawn in the order of the rows, or does some pixel's foot lie between them?
    if (mode_ == PaintMode::nearest ||
        (target_.range.x > target_.footInverse ? !reversed
                                               : reversed && target_.range.y <= target_.footInverse))
      pixelByPixel = false;
    const std::size_t count = splats_.size();
    if (!pixelByPixel) {
      for (std::size_t i = 0; i < count; ++i) painted += paint(splats_[reversed ? count - 1 - i : i]);
    } else if (reversed) {
      for (std::size_t last = count, first = count; last > 0; last = first) {
        for (--first; first > 0 && rowOf(first - 1) == rowOf(last - 1);) --first;
        painted += paintPixel(splats_.subspan(first, last - first));
      }
    } else {
      for (std::size_t first = 0, last = 0; first < count; first = last) {
        for (++last; last < count && rowOf(last) == rowOf(first);) ++last;
        painted += paintPixel(splats_.subspan(first, last - first));
      }
    }
    return painted;
  }

 private:
  std::uint32_t rowOf(std::size_t i) const { return target_.samples[splats_[i].index].row; }

  /// Samples of one pixel: those before the foot come nearer to the eye in stored order, those beyond it
  /// recede.
  std::uint64_t paintPixel(std::span<const Splat> splats) const {
    const auto foot = std::ranges::find_if(splats, [&](const Splat& splat) {
      return !(inverseDistanceOf(target_.samples[splat.index]) > target_.footInverse);
    });
    std::uint64_t painted = 0;
    for (auto i = splats.begin(); i != foot; ++i) painted += paint(*i);
    for (auto i = splats.end(); i != foot;) painted += paint(*--i);
    return painted;
  }

  /// Once, where its first pixel is.
  bool counts(int x) const {
    const int first = std::max(x, 0);
    return first >= target_.countedFrom && first < target_.countedTo;
  }

  /// May a splat of this mirror be painted there?
  bool open(std::size_t at, std::uint8_t mirror) const {
    if (target_.openBelow != 0 && slotOf(canvas_.pixels[at]) >= target_.openBelow) return false;
    return mode_ != PaintMode::reflect || canvas_.mirrors[at] == mirror;
  }

  /// Is it to be counted?
  bool paint(const Splat& splat) const {
    const std::uint32_t colour = wordOf(target_.colour[splat.index]);
    const bool opaque = colour >= 0xff000000u;
    const bool over = mode_ == PaintMode::over || mode_ == PaintMode::overBlended;
    if (!over && opaque == (mode_ == PaintMode::blendOnNearest)) return false;
    const std::uint8_t mirror = marks_ ? target_.mirror[splat.index] : std::uint8_t(0);
    const int x0 = std::max(splat.x, rect_.x0), x1 = std::min(splat.x + splat.side, rect_.x1);
    const int y0 = std::max(splat.y, rect_.y0), y1 = std::min(splat.y + splat.side, rect_.y1);
    const auto indexOf = [&](int x, int y) { return canvas_.indexOf(x) + static_cast<std::size_t>(y); };
    const bool counted = counts(splat.x) && open(indexOf(x0, y0), mirror);
    const bool tints = !opaque && mode_ != PaintMode::over;
    const std::uint64_t stamp = tints ? stampOf(target_, splat.index) : 0;
    for (int x = x0; x < x1; ++x)
      for (int y = y0; y < y1; ++y) {
        const std::size_t at = indexOf(x, y);
        if (!open(at, mirror)) continue;
        if (tints)
          tint(at, splat.pixel, colour, stamp);
        else
          paintOne(at, splat.pixel, mirror);
      }
    return counted;
  }

  void paintOne(std::size_t at, CanvasPixel painted, std::uint8_t mirror) const {
    CanvasPixel& pixel = canvas_.pixels[at];
    constexpr CanvasPixel kDepth = ~CanvasPixel(0xffffffff);
    if (mode_ == PaintMode::reflect) {  // a mirror's pixel keeps the mirror's own depth
      pixel = (pixel & kDepth) | (painted & ~kDepth);
      return;
    }
    if (mode_ == PaintMode::nearest && !(inverseZDepthOf(painted) > inverseZDepthOf(pixel))) return;
    pixel = painted;
    if (mirror != 0) canvas_.mirrors[at] = mirror, canvas_.mirrorPixels[at] = painted;
  }

  /// Of a sample that is not opaque.
  void tint(std::size_t at, CanvasPixel plain, std::uint32_t colour, std::uint64_t stamp) const {
    CanvasPixel& below = canvas_.pixels[at];
    if (mode_ != PaintMode::overBlended && !(inverseZDepthOf(plain) >= inverseZDepthOf(below))) return;
    const BlendedPixel pixel{below, canvas_.stamps[at], canvas_.blended[at]};
    if (target_.openBelow != 0 && (pixel.validStamp() >> 56) >= target_.openBelow)
      return;  // tinted by what is in front
    blendInto(pixel, colour, stamp);
  }

  const PaintTarget& target_;
  const PaintMode mode_;
  const std::span<const Splat> splats_;
  Canvas& canvas_;
  const PixelRect rect_;
  const bool marks_;
};

}  // namespace

std::uint64_t paintSplats(const PaintTarget& target, PaintMode mode, std::span<const Splat> splats,
                          bool reversed, bool pixelByPixel) {
  return Painter(target, mode, splats).paint(reversed, pixelByPixel);
}

}  // namespace acentric
