#pragma once
/// The kernel itself, over lanes B. Included by the three sources that instantiate it and by nothing else.

#include "engine/view/patch_kernel.h"

namespace acentric::patch_kernel {

/// Rays of a pixel, from its centre, in quarters of a pixel: no two in one eighth of it across or down.
/// Twice.
inline constexpr float kPartX4[2 * kPixelParts] = {0.25f,  -0.25f, 1.25f, -0.75f, -1.25f, -1.75f,
                                                   0.75f,  1.75f,  0.25f, -0.25f, 1.25f,  -0.75f,
                                                   -1.25f, -1.75f, 0.75f, 1.75f};
inline constexpr float kPartY4[2 * kPixelParts] = {-0.75f, 0.75f,  0.25f,  -1.25f, 1.25f, -0.25f,
                                                   1.75f,  -1.75f, -0.75f, 0.75f,  0.25f, -1.25f,
                                                   1.25f,  -0.25f, 1.75f,  -1.75f};

/// Where pixels' rays meet the patch, in texels from its first one's corner, and how that changes.
template <class B>
struct Places {
  typename B::F column, row;
  typename B::F columnAcross, rowAcross, columnDown, rowDown;  ///< to the next pixel right and below
};

/// Two texels by two.
template <class B>
struct Block {
  typename B::I first;        ///< the upper left one, from the corner of the patch's border
  typename B::I column, row;  ///< of that texel, from the same corner
  typename B::F right, down;  ///< of the place, from that texel's middle
};

/// Of words whose highest bit is 0.
template <class B>
typename B::M isZero(typename B::I v) {
  return B::greater(B::seti(1), v);
}

/// How many parts.
template <class B>
typename B::I countOf(typename B::I v) {
  v = v - B::both(B::template shiftRight<1>(v), B::seti(0x55));
  v = B::both(v, B::seti(0x33)) + B::both(B::template shiftRight<2>(v), B::seti(0x33));
  return B::both(v + B::template shiftRight<4>(v), B::seti(15));
}

/// Is anything open in those rows, or does any show a mirror?
template <class B>
bool isOpen(int first, int end, const PatchCanvasColumn& canvas, bool reflections) {
  const std::uint32_t* words = reflections ? canvas.mirror : canvas.open;
  typename B::I all = B::seti(0);
  for (int y = first; y < end; y += B::kWidth)
    all = B::maxi(all, B::both(B::load(words + y, end - y), B::seti(std::int32_t(kAllParts))));
  return B::any(B::greater(all, B::seti(0)));
}

/// Where a batch left nothing open, of its one or two cells those that have nothing open either.
template <class B>
void closeCells(int y0, int count, const PatchCanvasColumn& canvas, bool reflections) {
  const int last = (y0 + (count < B::kWidth ? count : B::kWidth) - 1) >> canvas.cellShift;
  for (int cell = y0 >> canvas.cellShift; cell <= last; ++cell) {
    const std::uint64_t bit = std::uint64_t(1) << cell;
    if ((*canvas.cells & bit) == 0) continue;
    const int end = (cell + 1) << canvas.cellShift;
    if (!isOpen<B>(cell << canvas.cellShift, end < canvas.rows ? end : canvas.rows, canvas, reflections))
      *canvas.cells &= ~bit;
  }
}

template <class B>
void findCells(const PatchCanvasColumn& canvas, bool reflections) {
  *canvas.cells = 0;
  for (int first = 0; first < canvas.rows; first += 1 << canvas.cellShift) {
    const int end = first + (1 << canvas.cellShift);
    const bool open = isOpen<B>(first, end < canvas.rows ? end : canvas.rows, canvas, reflections);
    *canvas.cells |= std::uint64_t(open) << (first >> canvas.cellShift);
  }
}

template <class B>
void settle(const PatchCanvasColumn& canvas, bool mirrors, std::uint64_t* pixels) {
  using F = typename B::F;
  using I = typename B::I;
  using M = typename B::M;
  const I none = B::seti(0), all = B::seti(std::int32_t(kAllParts)), codes = B::seti(255);
  for (int y = 0; y < canvas.rows; y += B::kWidth) {
    if ((*canvas.reached >> (y >> canvas.cellShift) & 1) == 0) continue;
    const int count = canvas.rows - y;
    const I mirror = canvas.mirror == nullptr ? none : B::load(canvas.mirror + y, count);
    const M ours = mirrors ? B::greater(mirror, none) : isZero<B>(mirror);
    if (!B::any(ours)) continue;
    I colour, depth;
    B::loadPairs(pixels + y, count, colour, depth);
    const I open = countOf<B>(B::load(canvas.open + y, count));
    const I source = B::load(canvas.source + y, count);
    const M isPainted = B::greater(source, none);
    // What lies behind also shows in a crack.
    const M behind = ours & B::greater(open, none) & B::notLess(B::asFloat(depth), B::set(0));
    const I shown = B::seti(kPixelParts) - open - countOf<B>(B::both(mirror, all));
    const M isReal = mirrors ? isPainted | B::greater(shown, none) : isPainted;
    const I number = shown + B::when(behind, open);
    const M wanted = ours & (behind | isReal) & B::greater(number, none);
    if (!B::any(wanted)) continue;
    const F share = B::select(behind, B::toFloat(open) * B::load(canvas.clear + y, count), B::set(0));
    const F parts = B::toFloat(B::maxi(number, B::seti(1)));
    const auto code = [&](const float* sums, I was) {
      const F before = B::toFloat(was);
      const F mean = (B::load(sums + y, count) + before * before * share) / parts;
      return B::truncate(B::min(B::sqrt(mean) + B::set(0.5f), B::set(255)));
    };
    const I red = code(canvas.red, B::both(colour, codes));
    const I green = code(canvas.green, B::both(B::template shiftRight<8>(colour), codes));
    const I blue = code(canvas.blue, B::both(B::template shiftRight<16>(colour), codes));
    const I slot = B::select(isPainted, B::template shiftRight<kSourceSlot>(source),
                             B::maxi(B::template shiftRight<24>(colour), B::seti(1)));
    const I mixed = red + B::template shiftLeft<8>(green) + B::template shiftLeft<16>(blue) +
                    B::template shiftLeft<24>(slot);
    const I itsDepth = B::when(isPainted, B::asInts(B::load(canvas.inverseZDepth + y, count)));
    B::storePairs(pixels + y, B::select(wanted, mixed, colour), B::select(wanted, itsDepth, depth), count);
  }
}

template <class B>
void reopen(const PatchCanvasColumn& canvas, std::uint32_t frontSlot, const std::uint64_t* pixels) {
  using I = typename B::I;
  using M = typename B::M;
  const I none = B::seti(0), all = B::seti(std::int32_t(kAllParts));
  for (int y = 0; y < canvas.rows; y += B::kWidth) {
    const int count = canvas.rows - y;
    const M ours = isZero<B>(canvas.mirror == nullptr ? none : B::load(canvas.mirror + y, count));
    const I open = B::load(canvas.open + y, count), source = B::load(canvas.source + y, count);
    const M wasOpen = B::greater(open + source, none);
    I colour, depth;
    B::loadPairs(pixels + y, count, colour, depth);
    const M isBehind =
        B::greater(B::seti(std::int32_t(frontSlot)), B::template shiftRight<24>(colour)) & wasOpen;
    B::store(canvas.open + y, B::select(ours, B::when(isBehind, all), open), count);
    B::store(canvas.source + y, B::select(ours, none, source), count);
    if (!B::any(ours & isBehind)) continue;  // nothing is painted here any more
    const auto reset = [&](float* values, float to) {
      B::store(values + y, B::select(ours, B::set(to), B::load(values + y, count)), count);
    };
    reset(canvas.red, 0), reset(canvas.green, 0), reset(canvas.blue, 0), reset(canvas.clear, 1);
  }
}

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

  /// See densityOf. With the singular values 1 / a and 1 / b of the derivatives' matrix, its determinant by
  /// the root of the sum of its squares.
  static I densityAt(const Places<B>& places) {
    const F area = places.columnAcross * places.rowDown - places.columnDown * places.rowAcross;
    const F squares = (places.columnAcross * places.columnAcross + places.rowAcross * places.rowAcross) +
                      (places.columnDown * places.columnDown + places.rowDown * places.rowDown);
    const F density = B::abs(area) / B::sqrt(B::max(squares, B::set(1e-20f)));
    return B::truncate(B::min(density, B::set(1)) * B::set(float(kMostDensity)));
  }

  static F limited(F value) { return B::min(B::max(value, B::set(-1e6f)), B::set(1e6f)); }

  /// The two texels by two around the place.
  Block<B> blockAt(const Places<B>& places) const {
    const F column = limited(places.column - B::set(0.5f)), row = limited(places.row - B::set(0.5f));
    const F left = B::min(B::max(B::floorOf(column), B::set(-1)), B::set(float(c.columns) - 1));
    const F top = B::min(B::max(B::floorOf(row), B::set(-1)), B::set(float(c.rows) - 1));
    const I i = B::truncate(left) + B::seti(1), j = B::truncate(top) + B::seti(1);
    return {B::times(i, B::seti(c.rows + 2)) + j, i, j, column - left, row - top};
  }
  /// What is read once covers are known, and for the columns of the picture that come next.
  void prefetch(std::int32_t texel) const {
    const int next = c.rows + 2;
    for (int i = 0; i < 3; ++i) __builtin_prefetch(c.colour + texel + i * next);
    __builtin_prefetch(c.cover + texel + 2 * next);
  }
  /// Do all rays of the pixel meet the block?
  static M isWithinBlock(const Places<B>& places) {
    const F columns = B::abs(places.columnAcross) + B::abs(places.columnDown);
    const F rows = B::abs(places.rowAcross) + B::abs(places.rowDown);
    return B::notLess(B::set(1), columns) & B::notLess(B::set(1), rows);
  }

  /// Parts of pixels that the patch covers, by the part of its texel that each ray meets; of `wanted` pixels.
  /// One pixel after the other, or two at once: lanes hold their parts.
  I partsOf(const Places<B>& places, M wanted) const {
    constexpr int kWidth = B::kWidth, kStep = kWidth < kPixelParts ? kWidth : kPixelParts;
    const F four = B::set(4);
    alignas(64) float column[kWidth], row[kWidth], derivatives[4][kWidth];
    B::store(column, four * places.column, kWidth), B::store(row, four * places.row, kWidth);
    B::store(derivatives[0], places.columnAcross, kWidth),
        B::store(derivatives[1], places.columnDown, kWidth);
    B::store(derivatives[2], places.rowAcross, kWidth), B::store(derivatives[3], places.rowDown, kWidth);
    alignas(64) std::uint32_t parts[kWidth] = {};
    for (unsigned left = B::bits(wanted); left != 0;) {
      const int first = __builtin_ctz(left);
      left &= left - 1;
      const int second = left != 0 ? __builtin_ctz(left) : first;
      const auto both = [&](const float* values) { return B::inHalves(values[first], values[second]); };
      const F columnAcross = both(derivatives[0]), columnDown = both(derivatives[1]);
      const F rowAcross = both(derivatives[2]), rowDown = both(derivatives[3]);
      const F column0 = both(column), row0 = both(row);
      unsigned covered = 0;
      for (int part = 0; part < kPixelParts; part += kStep) {
        const F dx = B::load(kPartX4 + part), dy = B::load(kPartY4 + part);
        const I i = partAt(column0 + (dx * columnAcross + dy * columnDown), c.columns);
        const I j = partAt(row0 + (dx * rowAcross + dy * rowDown), c.rows);
        const I texel = B::times(B::template shiftRight<2>(i), B::seti(c.rows + 2));
        const I cover = B::gather(c.cover, texel + B::template shiftRight<2>(j));
        const I bit = B::template shiftLeft<2>(B::both(j, B::seti(3))) + B::both(i, B::seti(3));
        const I own = B::both(B::shiftRightBy(cover, bit), B::seti(1));
        covered |= B::bits(isWanted(cover) & B::greater(own, B::seti(0))) << part;
      }
      parts[first] = covered & kAllParts;
      if constexpr (kWidth > kPixelParts) {
        parts[second] = second == first ? parts[first] : covered >> kPixelParts;
        left &= left - 1;
      }
    }
    return B::load(parts, kWidth);
  }
  /// The same of pixels whose rays all meet the block, all pixels at once: the parts of its four texels are
  /// the bits of two words, one for either column. `upperLeft`: the word of its first texel.
  I partsWithin(const Places<B>& places, const Block<B>& block, I upperLeft) const {
    I upperRight, lowerRight;
    B::gatherNext(c.cover, block.first + B::seti(c.rows + 2), upperRight, lowerRight);
    const I lowerLeft = B::gather(c.cover, block.first + B::seti(1));
    const auto wanted = [&](I cover) {
      return B::when(isWanted(cover), B::both(cover, B::seti(std::int32_t(kTexelParts))));
    };
    const I left = wanted(upperLeft) + B::template shiftLeft<16>(wanted(lowerLeft));
    const I right = wanted(upperRight) + B::template shiftLeft<16>(wanted(lowerRight));
    const I covered = B::maxi(B::maxi(wanted(upperLeft), wanted(lowerLeft)),
                              B::maxi(wanted(upperRight), wanted(lowerRight)));
    if (!B::any(B::greater(covered, B::seti(0)))) return B::seti(0);
    const F four = B::set(4), column = four * places.column, row = four * places.row;
    const I firstColumn = B::template shiftLeft<2>(block.column);
    const I firstRow = B::template shiftLeft<2>(block.row);
    I parts = B::seti(0);
    for (int part = 0; part < kPixelParts; ++part) {
      const F dx = B::set(kPartX4[part]), dy = B::set(kPartY4[part]);
      const I i =
          partAt(column + (dx * places.columnAcross + dy * places.columnDown), c.columns) - firstColumn;
      const I j = partAt(row + (dx * places.rowAcross + dy * places.rowDown), c.rows) - firstRow;
      const I cover = B::select(B::greater(i, B::seti(3)), right, left);
      const I bit = B::template shiftLeft<2>(j) + B::both(i, B::seti(3));
      const I own = B::both(B::shiftRightBy(cover, bit), B::seti(1));
      parts = parts + B::shiftLeftBy(own, part);
    }
    return parts;
  }
  /// From the border's first part on. Whatever lies beyond is the outermost of the border, which covers
  /// nothing.
  static I partAt(F place4, std::int32_t texels) {
    return B::truncate(B::min(B::max(place4 + B::set(4), B::set(0)), B::set(4 * float(texels) + 7)));
  }
  M isWanted(I cover) const { return has(cover, c.wantedRoles); }
  static M has(I word, std::uint32_t bits) {
    return B::greater(B::both(word, B::seti(std::int32_t(bits))), B::seti(0));
  }

  template <int kShift>
  static F channel(I word) {
    return B::toFloat(B::both(B::template shiftRight<kShift>(word), B::seti(255)));
  }

  /// Bilinear between the block's texels.
  void colourAt(const Block<B>& block, F* rgba) const {
    const F right = B::min(B::max(block.right, B::set(0)), B::set(1));
    const F down = B::min(B::max(block.down, B::set(0)), B::set(1));
    I a, b, d, e;
    B::gatherNext(c.colour, block.first, a, b);
    B::gatherNext(c.colour, block.first + B::seti(c.rows + 2), d, e);
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
    for (int y = first; y < end; y += B::kWidth) {
      const int cell = y >> canvas.cellShift;
      const std::uint64_t open = *canvas.cells >> cell;
      if (open == 0) break;
      const int skipped = __builtin_ctzll(open);
      if (skipped > 0) y = (cell + skipped) << canvas.cellShift;
      if (y >= end) break;
      const unsigned lanes = openLanes(y, end - y, canvas);
      if (lanes == 0) {
        closeCells<B>(y, end - y, canvas, c.reflects);
        continue;
      }
      if (end - y > B::kWidth) y += __builtin_ctz(lanes);
      painted += paintBatch(y, end - y, canvas);
    }
    return painted;
  }

  /// What the patch may paint, of all that is open.
  I openTo(I open, I mirror) const {
    if (!c.reflects) return open;
    const I other = B::different(B::template shiftRight<16>(mirror), B::seti(std::int32_t(c.mirror)));
    return B::when(isZero<B>(other), B::both(mirror, B::seti(std::int32_t(kAllParts))));
  }
  unsigned openLanes(int y, int count, const PatchCanvasColumn& canvas) const {
    const I open = B::load(canvas.open + y, count);
    const I mirror = c.reflects ? B::load(canvas.mirror + y, count) : B::seti(0);
    return B::bits(B::greater(openTo(open, mirror), B::seti(0)));
  }

  /// Parts of `wanted` pixels that the patch covers, of `within` those whose rays all meet the block.
  I edgesOf(const Places<B>& places, const Block<B>& block, I cover, M within, M wanted) const {
    constexpr int kFew = 4;  // one by one they take no longer
    if constexpr (B::kWidth > 1) {
      const M here = wanted & within;
      if (__builtin_popcount(B::bits(here)) > kFew) {
        const I parts = B::when(here, partsWithin(places, block, cover));
        const M others = B::greater(B::when(wanted, B::seti(1)), B::when(within, B::seti(1)));
        return B::any(others) ? B::select(others, partsOf(places, others), parts) : parts;
      }
    }
    return partsOf(places, wanted);
  }

  /// Whole batches are read and written: what lies beyond the rows stays as it is.
  int paintBatch(int y0, int count, const PatchCanvasColumn& canvas) const {
    const I before = loaded(canvas.open + y0);
    const F y = B::toFloat(B::counted(y0));
    Places<B> places;
    F x, slope, stretch, height;
    M wanted = place(y, x, slope, stretch, height, places) & B::greater(B::seti(count), B::counted(0));
    if (c.limited) {
      const M low = B::notLess(at(c.lowStart, c.lowStep, y), B::set(0)),
              high = B::less(B::set(0), at(c.highStart, c.highStep, y));
      wanted = c.eitherSide ? wanted & (low | high) : wanted & low & high;
    }
    const I open = B::when(wanted, openTo(before, c.reflects ? loaded(canvas.mirror + y0) : B::seti(0)));
    if (!B::any(B::greater(open, B::seti(0)))) return 0;
    differentiate(x, slope, stretch, height, places);
    const Block<B> block = blockAt(places);
    prefetch(B::lowest(block.first));
    const I cover = B::gather(c.cover, block.first);
    const M within = isWithinBlock(places);
    const M whole = isWanted(cover) & ((within & has(cover, kBlockWhole)) | has(cover, kBlockInner));
    I parts = B::when(whole, open);
    const M byEdges = B::greater(B::different(parts, open), B::seti(0));
    if (B::any(byEdges))
      parts = B::select(whole, parts, B::both(edgesOf(places, block, cover, within, byEdges), open));
    const M painted = B::greater(parts, B::seti(0));
    if (!B::any(painted)) return 0;
    blend(y0, count, y, before, open, parts, painted, places, block, canvas);
    return __builtin_popcount(B::bits(painted));
  }

  template <class T>
  static auto loaded(const T* words) {
    return B::load(words, B::kWidth);
  }

  void blend(int y0, int count, F y, I before, I open, I parts, M painted, const Places<B>& places,
             const Block<B>& block, const PatchCanvasColumn& canvas) const {
    F rgba[4];
    colourAt(block, rgba);
    const F number = B::toFloat(countOf<B>(parts));
    const F clear = loaded(canvas.clear + y0);
    F weight = clear * number;
    if (c.blended) {
      const F alpha = rgba[3] * B::set(1.0f / 255);
      weight = weight * alpha;
      const F share = number / B::max(B::toFloat(countOf<B>(open)), B::set(1));
      B::store(canvas.clear + y0, B::select(painted, clear * (B::set(1) - alpha * share), clear), B::kWidth);
    }
    const I mirror = canvas.mirror == nullptr ? B::seti(0) : loaded(canvas.mirror + y0);
    // What a mirror shows is painted later, in the place of its own colour.
    const bool waits = c.mirror != 0 && !c.reflects && canvas.mirror != nullptr;
    if (!waits) {
      const auto add = [&](float* sum, F code) {
        const F was = loaded(sum + y0);
        B::store(sum + y0, B::select(painted, was + code * code * weight, was), B::kWidth);
      };
      add(canvas.red, rgba[0]), add(canvas.green, rgba[1]), add(canvas.blue, rgba[2]);
    }
    if (c.blended) return;
    if (c.reflects) {
      B::store(canvas.mirror + y0, mirror - parts, B::kWidth);
      closeIfCovered(y0, count, open, parts, canvas);
      return;
    }
    B::store(canvas.open + y0, before - parts, B::kWidth);
    closeIfCovered(y0, count, before, parts, canvas);
    if (waits) {
      const I itsNumber = B::seti(std::int32_t(c.mirror << 16));
      const I others = B::both(mirror, B::seti(std::int32_t(kAllParts)));
      B::store(canvas.mirror + y0, B::select(painted, itsNumber + others + parts, mirror), B::kWidth);
    }
    const I source = loaded(canvas.source + y0);
    const I mine = countOf<B>(parts);
    const M more = painted & B::greater(mine, B::both(source, B::seti(255)));
    if (!B::any(more)) return;
    const I density = c.settled ? B::seti(std::int32_t(kMostDensity)) : densityAt(places);
    const I itsSource =
        mine + B::seti(std::int32_t(c.slot << kSourceSlot)) + B::template shiftLeft<kSourceDensity>(density);
    B::store(canvas.source + y0, B::select(more, itsSource, source), B::kWidth);
    const F depth = loaded(canvas.inverseZDepth + y0);
    B::store(canvas.inverseZDepth + y0, B::select(more, at(c.depthStart, c.depthStep, y), depth), B::kWidth);
  }

  void closeIfCovered(int y0, int count, I open, I parts, const PatchCanvasColumn& canvas) const {
    if (!B::any(B::greater(open - parts, B::seti(0)))) closeCells<B>(y0, count, canvas, c.reflects);
  }
};

template <class B>
int paint(const PatchColumn& patch, int first, int end, const PatchCanvasColumn& canvas) {
  return Kernel<B>{patch}.paint(first, end, canvas);
}

template <class B>
inline constexpr PatchKernel kVariant{paint<B>, findCells<B>, settle<B>, reopen<B>};

}  // namespace acentric::patch_kernel
