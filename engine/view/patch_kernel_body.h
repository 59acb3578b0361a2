#pragma once
/// The kernel itself, over lanes B. Included by the three sources that instantiate it and by nothing else.

#include "engine/view/patch_kernel.h"

namespace acentric::patch_kernel {

/// Rays of a pixel, from its centre: no two in one eighth of it across or down.
inline constexpr float kPartX[kPixelParts] = {0.0625f,  -0.0625f, 0.3125f, -0.1875f,
                                              -0.3125f, -0.4375f, 0.1875f, 0.4375f};
inline constexpr float kPartY[kPixelParts] = {-0.1875f, 0.1875f,  0.0625f, -0.3125f,
                                              0.3125f,  -0.0625f, 0.4375f, -0.4375f};

/// Where pixels' rays meet the patch, in texels from its first one's corner, and how that changes.
template <class B>
struct Places {
  typename B::F column, row;
  typename B::F columnAcross, rowAcross, columnDown, rowDown;  ///< to the next pixel right and below
};

template <class B>
struct Kernel {
  using F = typename B::F;
  using I = typename B::I;
  using M = typename B::M;

  const PatchColumn& c;

  F at(float start, float step, F y) const { return B::set(start) + B::set(step) * y; }

  /// Angles: of the direction in plan against the strip's middle (below 3 degrees), and of the elevation
  /// against that of the middle row (below 6): tangents by their series.
  static F angle(F tangent) {
    const F square = tangent * tangent;
    return tangent * (B::set(1) - square * (B::set(1.0f / 3) - square * B::set(0.2f)));
  }

  M place(F y, F& x, F& slope, F& stretch, F& height, Places<B>& out) const {
    x = at(c.start[0], c.step[0], y);
    const M before = B::less(B::set(0), x) & B::notLess(at(c.depthStart, c.depthStep, y), B::set(0));
    x = B::select(before, x, B::set(1));
    slope = at(c.start[1], c.step[1], y) / x;
    height = at(c.start[2], c.step[2], y);
    stretch = B::sqrt(B::set(1) + slope * slope);
    const F distance = x * stretch, middle = B::set(c.middleTangent);
    out.column = B::set(c.columnOffset) + B::set(c.columnsPerRadian) * angle(slope);
    out.row = B::set(c.rowOffset) -
              B::set(c.rowsPerRadian) * angle((height - middle * distance) / (distance + middle * height));
    return before;
  }

  void differentiate(F x, F slope, F stretch, F height, Places<B>& out) const {
    const F distance = x * stretch;
    const F perSlope = B::set(c.columnsPerRadian) / (x * stretch * stretch);
    const F perHeight = B::set(c.rowsPerRadian) / (distance * distance + height * height);
    const auto one = [&](const float* step, F& column, F& row) {
      const F dx = B::set(step[0]), dy = B::set(step[1]), dz = B::set(step[2]);
      column = (dy - slope * dx) * perSlope;
      row = (height * ((dx + slope * dy) / stretch) - dz * distance) * perHeight;
    };
    one(c.across, out.columnAcross, out.rowAcross);
    one(c.step, out.columnDown, out.rowDown);
  }

  I texelAt(I column, I row) const {
    const I i = B::mini(B::maxi(column, B::seti(-1)), B::seti(c.columns)) + B::seti(1);
    const I j = B::mini(B::maxi(row, B::seti(-1)), B::seti(c.rows)) + B::seti(1);
    return B::times(i, B::seti(c.rows + 2)) + j;
  }
  static F limited(F value) { return B::min(B::max(value, B::set(-1e6f)), B::set(1e6f)); }

  /// Parts of the pixels that the patch covers.
  I partsOf(const Places<B>& places) const {
    I parts = B::seti(0);
    for (int part = 0; part < kPixelParts; ++part) {
      const F dx = B::set(kPartX[part]), dy = B::set(kPartY[part]);
      const F column = places.column + (dx * places.columnAcross + dy * places.columnDown);
      const F row = places.row + (dx * places.rowAcross + dy * places.rowDown);
      const I fourColumns = B::floor(limited(column * B::set(4))),
              fourRows = B::floor(limited(row * B::set(4)));
      const I cover = B::gather(
          c.cover, texelAt(B::template shiftSigned<2>(fourColumns), B::template shiftSigned<2>(fourRows)));
      const I bit =
          B::template shiftLeft<2>(B::both(fourRows, B::seti(3))) + B::both(fourColumns, B::seti(3));
      const I covered = B::when(isWanted(cover), B::both(B::shiftRightBy(cover, bit), B::seti(1)));
      parts = parts + B::shiftLeftBy(covered, part);
    }
    return parts;
  }
  M isWanted(I cover) const {
    return B::greater(B::both(cover, B::seti(std::int32_t(c.wantedRoles))), B::seti(0));
  }

  /// How many parts.
  static I countOf(I v) {
    v = v - B::both(B::template shiftRight<1>(v), B::seti(0x55));
    v = B::both(v, B::seti(0x33)) + B::both(B::template shiftRight<2>(v), B::seti(0x33));
    return B::both(v + B::template shiftRight<4>(v), B::seti(15));
  }

  template <int kShift>
  static F channel(I word) {
    return B::toFloat(B::both(B::template shiftRight<kShift>(word), B::seti(255)));
  }

  /// Bilinear between the four texels around the place.
  void colourAt(const Places<B>& places, F* rgba) const {
    const F column = limited(places.column - B::set(0.5f)), row = limited(places.row - B::set(0.5f));
    const F left = B::min(B::max(B::floorOf(column), B::set(-1)), B::set(float(c.columns) - 1));
    const F top = B::min(B::max(B::floorOf(row), B::set(-1)), B::set(float(c.rows) - 1));
    const F right = B::min(B::max(column - left, B::set(0)), B::set(1));
    const F down = B::min(B::max(row - top, B::set(0)), B::set(1));
    const I first =
        B::times(B::truncate(left) + B::seti(1), B::seti(c.rows + 2)) + B::truncate(top) + B::seti(1);
    const I second = first + B::seti(c.rows + 2);
    const I a = B::gather(c.colour, first), b = B::gather(c.colour, first + B::seti(1));
    const I d = B::gather(c.colour, second), e = B::gather(c.colour, second + B::seti(1));
    const auto mix = [&](F va, F vb, F vd, F ve) {
      const F leftSide = va + (vb - va) * down, rightSide = vd + (ve - vd) * down;
      return leftSide + (rightSide - leftSide) * right;
    };
    rgba[0] = mix(channel<0>(a), channel<0>(b), channel<0>(d), channel<0>(e));
    rgba[1] = mix(channel<8>(a), channel<8>(b), channel<8>(d), channel<8>(e));
    rgba[2] = mix(channel<16>(a), channel<16>(b), channel<16>(d), channel<16>(e));
    if (c.blended) rgba[3] = mix(channel<24>(a), channel<24>(b), channel<24>(d), channel<24>(e));
  }

  int paint(int first, int end, const PatchCanvasColumn& canvas) const {
    int painted = 0;
    for (int y0 = first; y0 < end; y0 += B::kWidth) painted += paintBatch(y0, end - y0, canvas);
    return painted;
  }

  int paintBatch(int y0, int count, const PatchCanvasColumn& canvas) const {
    I open = B::load(canvas.open + y0, count);
    const I before = open;
    if (c.reflects) {
      const I mirror = B::load(canvas.mirror + y0, count);
      const I other = B::different(B::template shiftRight<16>(mirror), B::seti(std::int32_t(c.mirror)));
      open = B::when(B::greater(B::seti(1), other), B::both(mirror, B::seti(std::int32_t(kAllParts))));
    }
    if (!B::any(B::greater(open, B::seti(0)))) return 0;
    const F y = B::toFloat(B::counted(y0));
    Places<B> places;
    F x, slope, stretch, height;
    const M inFront = place(y, x, slope, stretch, height, places);
    M wanted = inFront;
    if (c.limited) {
      const M low = B::notLess(at(c.lowStart, c.lowStep, y), B::set(0)),
              high = B::less(B::set(0), at(c.highStart, c.highStep, y));
      wanted = c.eitherSide ? wanted & (low | high) : wanted & low & high;
    }
    open = B::when(wanted, open);
    if (!B::any(B::greater(open, B::seti(0)))) return 0;
    const I cover =
        B::gather(c.cover, texelAt(B::floor(limited(places.column)), B::floor(limited(places.row))));
    const M inner =
        isWanted(cover) & B::greater(B::both(cover, B::seti(std::int32_t(kTexelInner))), B::seti(0));
    I parts = B::when(inner, open);
    if (B::any(B::greater(B::different(parts, open), B::seti(0)))) {
      differentiate(x, slope, stretch, height, places);
      parts = B::select(inner, parts, B::both(partsOf(places), open));
    }
    const M painted = B::greater(parts, B::seti(0));
    if (!B::any(painted)) return 0;
    blend(y0, count, y, before, open, parts, painted, places, canvas);
    return __builtin_popcount(B::bits(painted));
  }

  void blend(int y0, int count, F y, I before, I open, I parts, M painted, const Places<B>& places,
             const PatchCanvasColumn& canvas) const {
    F rgba[4];
    colourAt(places, rgba);
    const F number = B::toFloat(countOf(parts));
    const F clear = B::load(canvas.clear + y0, count);
    F weight = clear * number;
    if (c.blended) {
      const F alpha = rgba[3] * B::set(1.0f / 255);
      weight = weight * alpha;
      const F share = number / B::max(B::toFloat(countOf(open)), B::set(1));
      B::store(canvas.clear + y0, B::select(painted, clear * (B::set(1) - alpha * share), clear), count);
    }
    const I mirror = canvas.mirror == nullptr ? B::seti(0) : B::load(canvas.mirror + y0, count);
    // What a mirror shows is painted later, in the place of its own colour.
    const bool waits = c.mirror != 0 && !c.reflects && canvas.mirror != nullptr;
    if (!waits) {
      const auto add = [&](float* sum, F code) {
        const F was = B::load(sum + y0, count);
        B::store(sum + y0, B::select(painted, was + code * code * weight, was), count);
      };
      add(canvas.red, rgba[0]), add(canvas.green, rgba[1]), add(canvas.blue, rgba[2]);
    }
    if (c.blended) return;
    if (c.reflects) {
      B::store(canvas.mirror + y0, mirror - parts, count);
      return;
    }
    B::store(canvas.open + y0, before - parts, count);
    if (waits) {
      const I itsNumber = B::seti(std::int32_t(c.mirror << 16));
      const I others = B::both(mirror, B::seti(std::int32_t(kAllParts)));
      B::store(canvas.mirror + y0, B::select(painted, itsNumber + others + parts, mirror), count);
    }
    const I source = B::load(canvas.source + y0, count);
    const I mine = countOf(parts);
    const M more = painted & B::greater(mine, B::both(source, B::seti(255)));
    B::store(canvas.source + y0, B::select(more, mine + B::seti(std::int32_t(c.slot << 8)), source), count);
    const F depth = B::load(canvas.inverseZDepth + y0, count);
    B::store(canvas.inverseZDepth + y0, B::select(more, at(c.depthStart, c.depthStep, y), depth), count);
  }
};

}  // namespace acentric::patch_kernel
