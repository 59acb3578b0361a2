#pragma once
/// The kernel itself, over a batch type B that provides float lanes F, integer lanes I and masks M.
/// Included by the four sources that instantiate it and by nothing else.

#include <cstddef>

#include "engine/view/warp_kernel.h"

namespace acentric::warp_kernel {

/// Beyond this many pixels an image position is no candidate, and converting it to an integer is no longer
/// safe.
inline constexpr float kFarPixel = 30000.0f;

/// A splat reaches this far beyond half its side: half a pixel for its size and half a one for its place,
/// both rounded to pixels, and rounding errors.
inline constexpr float kSplatSlack = 1.25f;

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
                         const SampleRun* runs, int runCount, const SplatArrays& out) {
  const ProjectColumnOf<T> column = constants;  // a copy that no splat is written over, for registers
  const SplatArrays to = out;
  const SampleColumnOf<T> from = samples;
  int written = 0;
  for (int r = 0; r < runCount; ++r) {
    std::uint32_t i = runs[r].first;
    const std::uint32_t end = runs[r].end;
    for (; i + B::kWidth <= end; i += B::kWidth) {
      __builtin_prefetch(from.samples + i + kAhead);
      __builtin_prefetch(from.samples + i + kAhead + 8);
      __builtin_prefetch(from.colour + 4 * std::size_t(i + kAhead));
      written += projectBatch<B>(column, from.rowTangent, from.samples + i,
                                 B::words(from.colour + 4 * std::size_t(i), B::kWidth), i, to, written);
    }
    if (i == end) continue;
    PackedSample last[B::kWidth];
    for (std::uint32_t lane = 0; lane < B::kWidth; ++lane) {
      last[lane] = from.samples[i + lane < end ? i + lane : end - 1];
      if (i + lane >= end) last[lane].inverseDistanceAndRoles = 0;
    }
    written += projectBatch<B>(column, from.rowTangent, last,
                               B::words(from.colour + 4 * std::size_t(i), static_cast<int>(end - i)), i, to,
                               written);
  }
  return written;
}

/// May samples between these tangents and inverse distances put a splat on an open tile? Image positions are
/// quotients of functions that are linear in tangent and inverse distance each, so the corners are extremes;
/// of the size of squares too, but for a factor that grows away from the middle of the picture.
template <class B>
inline typename B::M reachesOpenTile(const ProjectColumn& c, const BlockTest& test, typename B::F lowT,
                                     typename B::F highT, typename B::F lowW, typename B::F highW) {
  using F = typename B::F;
  using I = typename B::I;
  const F steepest = B::max(B::abs(lowT), B::abs(highT));
  F perDepth[4], place[2][4];
  const auto corner = [&](int i, F t, F w) {
    const auto at = [&](int axis) {
      return B::set(c.a[axis]) + t * B::set(c.z[axis]) + w * B::set(c.b[axis]);
    };
    // Beside or behind the eye: as far away as can be.
    const F depth = B::max(at(2), B::set(1e-6f));
    perDepth[i] = B::set(1) / depth;
    place[0][i] = at(0) * perDepth[i], place[1][i] = at(1) * perDepth[i];
    return B::less(B::set(1e-3f) * (B::set(1) + steepest), at(2));
  };
  const typename B::M before =
      corner(0, lowT, lowW) & corner(1, lowT, highW) & corner(2, highT, lowW) & corner(3, highT, highW);
  const auto least = [](const F* p) { return B::min(B::min(p[0], p[1]), B::min(p[2], p[3])); };
  const auto most = [](const F* p) { return B::max(B::max(p[0], p[1]), B::max(p[2], p[3])); };
  const auto off = [&](const F* p, float centre) {
    const F far =
        B::max(B::abs(least(p) - B::set(centre)), B::abs(most(p) - B::set(centre))) * B::set(c.inverseFocal);
    return far * far;
  };
  const F stretch = B::sqrt((B::set(1) + steepest * steepest) *
                            (B::set(1) + off(place[0], c.centreX) + off(place[1], c.centreY)));
  const F side = B::min(stretch * most(perDepth) * B::set(c.footprint), B::set(c.maxSide));
  const F margin = B::set(0.5f) * side + B::set(kSplatSlack);
  // Tiles [first, end) along an axis, at least one.
  const auto tiles = [&](const F* p, std::int32_t from, int sideBits, std::int32_t count, I& first, I& end) {
    const F toTile = B::set(1.0f / static_cast<float>(1 << sideBits)),
            last = B::set(static_cast<float>(count - 1));
    const auto tile = [&](F x) {
      const F t = (x - B::set(static_cast<float>(from))) * toTile;
      return B::floor(B::max(B::min(t, last), B::set(0)));
    };
    first = tile(least(p) - margin), end = tile(most(p) + margin) + B::seti(1);
  };
  I left, right, top, bottom;
  tiles(place[0], c.x0, kTileWidthBits, test.tileColumns, left, right);
  tiles(place[1], c.y0, kTileHeightBits, test.tileRows, top, bottom);
  const auto sum = [&](I column, I row) {
    return B::gather(test.openTiles, B::times(column, B::seti(test.tileRows + 1)) + row);
  };
  const I open = sum(right, bottom) - sum(left, bottom) - sum(right, top) + sum(left, top);
  return B::either(B::greater(open, B::seti(0)), before);
}

template <class B>
inline int findBlocks(const ProjectColumn& column, const BlockTest& test, const BlockColumn& blocks,
                      int count, std::uint16_t* out) {
  using F = typename B::F;
  using M = typename B::M;
  int found = 0;
  for (int first = 0; first < count; first += B::kWidth) {
    const F lowT = B::load(blocks.lowTangent + first), highT = B::load(blocks.highTangent + first);
    const F lowW = B::max(B::load(blocks.leastInverse + first), B::set(column.minInverseDistance));
    const F highW = B::min(B::load(blocks.mostInverse + first), B::set(column.maxInverseDistance));
    M kept = B::needed(blocks.roles + first, column.roles) & B::notLess(highW, lowW);
    const F slack = highW * B::set(test.slack);
    for (int i = 0; i < 5; ++i) {
      const F z = B::set(test.z[i]), b = B::set(test.b[i]);
      kept = kept &
             B::notLess(B::set(test.a[i]) + B::max(lowT * z, highT * z) + B::max(lowW * b, highW * b) + slack,
                        B::set(0));
    }
    if (!B::any(kept)) continue;
    if (test.openTiles != nullptr) kept = kept & reachesOpenTile<B>(column, test, lowT, highT, lowW, highW);
    const int left = count - first;
    unsigned bits = B::bits(kept);
    if (left < B::kWidth) bits &= (1u << left) - 1;
    for (; bits != 0; bits &= bits - 1)
      out[found++] = static_cast<std::uint16_t>(first + __builtin_ctz(bits));
  }
  return found;
}

}  // namespace acentric::warp_kernel
