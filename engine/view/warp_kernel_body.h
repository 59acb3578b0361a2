#pragma once
/// The kernel itself, over a batch type B that provides float lanes F, integer lanes I and masks M.
/// Included by the four sources that instantiate it and by nothing else.

#include <cstddef>

#include "engine/view/warp_kernel.h"

namespace acentric::warp_kernel {

/// Beyond this many pixels an image position is no candidate, and converting it to an integer is no longer
/// safe.
inline constexpr float kFarPixel = 30000.0f;

template <class B, class C>
inline typename B::M insidePart(const C& c, typename B::F w) {
  const typename B::F x = B::set(c.direction[0]) + w * B::set(c.baseline[0]);
  const typename B::F y = B::set(c.direction[1]) + w * B::set(c.baseline[1]);
  const typename B::F fromLow = B::set(c.low[0]) * y - B::set(c.low[1]) * x;
  const typename B::F toHigh = x * B::set(c.high[1]) - y * B::set(c.high[0]);
  if (c.partTest == PartTest::within) return B::notLess(fromLow, B::set(0)) & B::less(B::set(0), toHigh);
  return B::notLess(fromLow, B::set(0)) | B::less(B::set(0), toHigh);
}

template <class B, class C>
inline typename B::M touches(const C& c, typename B::I x, typename B::I y, typename B::I side) {
  return B::greater(B::seti(c.x1), x) & B::greater(B::seti(c.y1), y) & B::greater(x + side, B::seti(c.x0)) &
         B::greater(y + side, B::seti(c.y0));
}

/// Writes the accepted splats one after the other (and whatever it likes behind them), and returns how many.
template <class B, class C>
inline int appendSplats(const C& c, typename B::M accepted, typename B::I x, typename B::I y,
                        typename B::I side, typename B::F inverseZDepth, typename B::I colour,
                        std::uint32_t firstIndex, const SplatArrays& out, int written) {
  using I = typename B::I;
  const unsigned bits = B::bits(accepted);
  if (bits == 0) return 0;
  const auto notAbove = [](I a, std::int32_t limit) { return B::greater(B::seti(limit + 1), a); };
  const std::int32_t canvasHeight = c.y1 - c.y0;
  const typename B::M whole = notAbove(side, 2) & B::greater(x, B::seti(c.x0 - 1)) &
                              B::greater(y, B::seti(c.y0 - 1)) & notAbove(x + side, c.x1) &
                              notAbove(y + side, c.y1) &
                              B::greater(B::template shiftRight<24>(colour), B::seti(254));
  const I steps =
      B::seti(kWholeSplat) + B::when(B::greater(side, B::seti(1)), B::seti(canvasHeight + (1 << 16)));
  const I depth = B::asInts(inverseZDepth);
  const I first = B::times(x - B::seti(c.x0), B::seti(canvasHeight)) + y - B::seti(c.y0);
  const I word = B::both(colour, B::seti(0xffffff)) + B::seti(static_cast<std::int32_t>(c.slot << 24));
  const auto kept = B::kept(accepted);
  B::storePairs(out.pixels + written, B::together(kept, word), B::together(kept, depth));
  B::storeAll(out.steps + written, B::together(kept, B::when(whole, steps)));
  B::storeAll(out.firsts + written, B::together(kept, first));
  B::storeAll(out.corners + written,
              B::together(kept, B::both(x, B::seti(0xffff)) + B::template shiftLeft<16>(y)));
  B::storeAll(out.sides + written, B::together(kept, side));
  B::storeAll(out.indices + written, B::together(kept, B::counted(static_cast<std::int32_t>(firstIndex))));
  return __builtin_popcount(bits);
}

/// Samples of no role are dropped.
template <class B, class C, class T>
[[gnu::always_inline]] inline int projectBatch(const C& c, const T* rowTangent, const PackedSample* samples,
                                               typename B::I colour, std::uint32_t firstIndex,
                                               const SplatArrays& out, int written) {
  using F = typename B::F;
  using I = typename B::I;
  using M = typename B::M;
  I inverseAndRoles, row;
  B::load(samples, inverseAndRoles, row);
  const F w = B::asFloat(B::both(inverseAndRoles, B::seti(~0xff)));
  const F t = B::tangents(rowTangent, samples, row);
  const F qz = B::set(c.a[2]) + t * B::set(c.z[2]) + w * B::set(c.b[2]);
  M accepted = B::needed(inverseAndRoles, c.roles) & B::less(B::set(0), qz) &
               B::notLess(B::set(c.maxInverseDistance), w);
  if (c.minInverseDistance > 0) accepted = accepted & B::notLess(w, B::set(c.minInverseDistance));
  if (c.partTest != PartTest::none) accepted = accepted & insidePart<B>(c, w);
  if (!B::any(accepted)) return 0;

  const F qx = B::set(c.a[0]) + t * B::set(c.z[0]) + w * B::set(c.b[0]);
  const F qy = B::set(c.a[1]) + t * B::set(c.z[1]) + w * B::set(c.b[1]);
  const F perDepth = B::set(1) / qz;
  const F u = qx * perDepth;
  const F v = qy * perDepth;
  accepted = accepted & B::less(B::abs(u), B::set(kFarPixel)) & B::less(B::abs(v), B::set(kFarPixel));

  // A sample stands for pitch * distance across; seen under an angle off the view axis the picture stretches
  // it.
  const F offX = (u - B::set(c.centreX)) * B::set(c.inverseFocal);
  const F offY = (v - B::set(c.centreY)) * B::set(c.inverseFocal);
  const F stretch = B::sqrt((B::set(1) + t * t) * (B::set(1) + offX * offX + offY * offY));
  const F wanted = B::max(B::min(stretch * perDepth * B::set(c.footprint), B::set(c.maxSide)), B::set(1));
  const I side = B::ceil(wanted);
  const F half = B::set(0.5f) - B::set(0.5f) * B::toFloat(side);
  // The pixels whose centres lie in the square around (u, v).
  const I x = B::floor(B::select(accepted, u, B::set(0)) + half);
  const I y = B::floor(B::select(accepted, v, B::set(0)) + half);
  accepted = accepted & touches<B>(c, x, y, side);
  return appendSplats<B>(c, accepted, x, y, side, w * perDepth, colour, firstIndex, out, written);
}

/// Samples are asked for so many ahead of their use.
inline constexpr std::uint32_t kAhead = 160;

template <class B, class T>
inline int projectColumn(const ProjectColumnOf<T>& constants, const SampleColumnOf<T>& samples,
                         std::uint32_t count, const SplatArrays& out) {
  const ProjectColumnOf<T> column = constants;  // a copy that no splat is written over, for registers
  const SplatArrays to = out;
  const SampleColumnOf<T> from = samples;
  int written = 0;
  std::uint32_t i = 0;
  for (; i + B::kWidth <= count; i += B::kWidth) {
    __builtin_prefetch(from.samples + i + kAhead);
    __builtin_prefetch(from.samples + i + kAhead + 8);
    __builtin_prefetch(from.colour + 4 * std::size_t(i + kAhead));
    written += projectBatch<B>(column, from.rowTangent, from.samples + i,
                               B::words(from.colour + 4 * std::size_t(i), B::kWidth), i, to, written);
  }
  if (i == count) return written;
  PackedSample last[B::kWidth];
  for (std::uint32_t lane = 0; lane < B::kWidth; ++lane) {
    last[lane] = from.samples[i + lane < count ? i + lane : count - 1];
    if (i + lane >= count) last[lane].inverseDistanceAndRoles = 0;
  }
  return written + projectBatch<B>(column, from.rowTangent, last,
                                   B::words(from.colour + 4 * std::size_t(i), static_cast<int>(count - i)), i,
                                   to, written);
}

}  // namespace acentric::warp_kernel
