#pragma once
/// The kernel itself, over a batch type B that provides float lanes F, integer lanes I and masks M.
/// Included by the two sources that instantiate it and by nothing else.

#include "engine/view/warp_kernel.h"

namespace acentric::warp_kernel {

/// Beyond this many pixels an image position is no candidate, and converting it to an integer is no longer
/// safe.
inline constexpr float kFarPixel = 30000.0f;

template <class B>
inline typename B::M insidePart(const ProjectColumn& c, typename B::F w) {
  const typename B::F x = B::set(c.direction[0]) + w * B::set(c.baseline[0]);
  const typename B::F y = B::set(c.direction[1]) + w * B::set(c.baseline[1]);
  const typename B::F fromLow = B::set(c.low[0]) * y - B::set(c.low[1]) * x;
  const typename B::F toHigh = x * B::set(c.high[1]) - y * B::set(c.high[0]);
  if (c.partTest == PartTest::within) return B::notLess(fromLow, B::set(0)) & B::less(B::set(0), toHigh);
  return B::notLess(fromLow, B::set(0)) | B::less(B::set(0), toHigh);
}

template <class B>
inline typename B::M touches(const ProjectColumn& c, typename B::I x, typename B::I y, typename B::I width,
                             typename B::I height) {
  return B::greater(B::seti(c.x1), x) & B::greater(B::seti(c.y1), y) & B::greater(x + width, B::seti(c.x0)) &
         B::greater(y + height, B::seti(c.y0));
}

/// The pixels [first, first + size) whose centres lie within `half` of `centre`, at least one; and where
/// `centre` lies in them, eighths of a pixel.
template <class B>
inline void span(typename B::F centre, typename B::F half, typename B::I& first, typename B::I& size,
                 typename B::I& place) {
  const typename B::F middle = centre - B::set(0.5f);
  first = B::ceil(middle - half);
  size = B::maxi(B::ceil(middle + half) - first, B::seti(1));
  const typename B::I eighths = B::floor((centre - B::toFloat(first)) * B::set(8) + B::set(0.5f));
  place = B::mini(B::maxi(eighths, B::seti(0)), B::seti(255));
}

/// Rectangles around the picture of the piece of surface that a sample stands for: a parallelogram, whose
/// sides are the derivatives of (u, v) along a row and a column of the capture, the sample's slant included.
template <class B>
inline int appendRectangles(const ProjectColumn& c, typename B::M accepted, typename B::F t, typename B::F w,
                            typename B::F u, typename B::F v, typename B::F perDepth, const Slant* slant,
                            std::uint32_t firstIndex, Splat* out) {
  using F = typename B::F;
  using I = typename B::I;
  F across, down;
  B::slants(slant, across, down);
  const F acrossW = w * across * B::set(c.acrossStep), downW = w * down * B::set(c.downStep);
  const F rise = (B::set(1) + t * t) * B::set(c.downStep);
  const F acrossZ = B::set(c.across[2]) + acrossW * B::set(c.b[2]);
  const F downZ = downW * B::set(c.b[2]) - rise * B::set(c.z[2]);
  const auto half = [&](int axis, F at) {
    const F a = B::set(c.across[axis]) + acrossW * B::set(c.b[axis]) - at * acrossZ;
    const F d = downW * B::set(c.b[axis]) - rise * B::set(c.z[axis]) - at * downZ;
    return B::min(B::max((B::abs(a) + B::abs(d)) * perDepth, B::set(0.5f)), B::set(0.5f) * B::set(c.maxSide));
  };
  const F halfX = half(0, u), halfY = half(1, v);
  I x, y, width, height, placeX, placeY;
  span<B>(B::select(accepted, u, B::set(0)), halfX, x, width, placeX);
  span<B>(B::select(accepted, v, B::set(0)), halfY, y, height, placeY);
  // Its shorter side tells how far apart samples lie; the longer one may be due to the slant.
  const I spread = B::floor(B::set(8.5f) - B::set(c.perSpread) / B::min(halfX, halfY));
  return B::append(accepted & touches<B>(c, x, y, width, height), x, y,
                   B::pack(width, height, placeX, placeY), firstIndex,
                   B::mini(B::maxi(spread, B::seti(0)), B::seti(7)), w * perDepth, out);
}

/// Lanes beyond `count` must hold an inverse distance of NaN.
template <class B>
[[gnu::always_inline]] inline int projectBatch(const ProjectColumn& c, const float* rowTangent,
                                               const std::uint16_t* row, const float* inverseDistance,
                                               const std::uint8_t* roles, const Slant* slant,
                                               std::uint32_t firstIndex, Splat* out) {
  using F = typename B::F;
  using I = typename B::I;
  using M = typename B::M;
  const F w = B::load(inverseDistance);
  const F t = B::gather(rowTangent, row);
  const F qz = B::set(c.a[2]) + t * B::set(c.z[2]) + w * B::set(c.b[2]);
  M accepted =
      B::needed(roles, c.roles) & B::less(B::set(0), qz) & B::notLess(B::set(c.maxInverseDistance), w);
  if (c.minInverseDistance > 0) accepted = accepted & B::notLess(w, B::set(c.minInverseDistance));
  if (c.partTest != PartTest::none) accepted = accepted & insidePart<B>(c, w);
  if (!B::any(accepted)) return 0;

  const F qx = B::set(c.a[0]) + t * B::set(c.z[0]) + w * B::set(c.b[0]);
  const F qy = B::set(c.a[1]) + t * B::set(c.z[1]) + w * B::set(c.b[1]);
  const F perDepth = B::set(1) / qz;
  const F u = qx * perDepth;
  const F v = qy * perDepth;
  accepted = accepted & B::less(B::abs(u), B::set(kFarPixel)) & B::less(B::abs(v), B::set(kFarPixel));

  if (c.slanted) return appendRectangles<B>(c, accepted, t, w, u, v, perDepth, slant, firstIndex, out);
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
  accepted = accepted & touches<B>(c, x, y, side, side);
  return B::append(accepted, x, y, B::pack(side, side, B::seti(0), B::seti(0)), firstIndex, B::seti(0),
                   w * perDepth, out);
}

template <class B>
inline int projectColumn(const ProjectColumn& constants, const float* rowTangent, const std::uint16_t* row,
                         const float* inverseDistance, const std::uint8_t* roles, const Slant* slant,
                         int count, std::uint32_t firstIndex, Splat* out) {
  const ProjectColumn column = constants;  // a copy that no splat is written over: it stays in registers
  int written = 0, i = 0;
  for (; i + B::kWidth <= count; i += B::kWidth)
    written += projectBatch<B>(column, rowTangent, row + i, inverseDistance + i, roles + i,
                               column.slanted ? slant + i : nullptr,
                               firstIndex + static_cast<std::uint32_t>(i), out + written);
  if (i < count) {
    std::uint16_t lastRow[B::kWidth];
    float lastInverse[B::kWidth];
    std::uint8_t lastRoles[B::kWidth];
    Slant lastSlant[B::kWidth];
    for (int lane = 0; lane < B::kWidth; ++lane) {
      lastRow[lane] = row[i + lane < count ? i + lane : count - 1];
      lastInverse[lane] = i + lane < count ? inverseDistance[i + lane] : __builtin_nanf("");
      lastRoles[lane] = i + lane < count ? roles[i + lane] : std::uint8_t(0);
      lastSlant[lane] = column.slanted && i + lane < count ? slant[i + lane] : Slant{};
    }
    written += projectBatch<B>(column, rowTangent, lastRow, lastInverse, lastRoles, lastSlant,
                               firstIndex + static_cast<std::uint32_t>(i), out + written);
  }
  return written;
}

}  // namespace acentric::warp_kernel
