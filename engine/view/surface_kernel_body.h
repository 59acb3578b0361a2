#pragma once
/// The kernel itself, over a batch type B (lanes_scalar.h). Included by the sources that instantiate it and
/// by nothing else. What it computes is what TextureSampler::colour, interpolatedLight and encodeForDisplay
/// compute: tests compare them.

#include "engine/image/tone_curve.h"
#include "engine/view/surface_kernel.h"

namespace acentric::surface_kernel {

template <class B>
struct Colours {
  typename B::F channel[3];
};

template <class B>
typename B::F clampToUnit(typename B::F a) {
  return B::min(B::max(a, B::set(0)), B::set(1));
}
template <class B>
typename B::I clampTo(typename B::I a, std::int32_t low, std::int32_t high) {
  return B::mini(B::maxi(a, B::seti(low)), B::seti(high));
}
template <class B>
typename B::F mix(typename B::F a, typename B::F b, typename B::F share) {
  return a * (B::set(1) - share) + b * share;
}

/// A coordinate in [0, 1].
template <class B>
typename B::F wrapped(typename B::F t, TextureWrap wrap) {
  const typename B::F usable = B::select(B::less(B::abs(t), B::set(__builtin_inff())), t, B::set(0));
  if (wrap == TextureWrap::repeat) return usable - B::floorOf(usable);
  if (wrap == TextureWrap::clamp) return clampToUnit<B>(usable);
  const typename B::F period = usable - B::set(2) * B::floorOf(usable * B::set(0.5f));
  return B::select(B::less(B::set(1), period), B::set(2) - period, period);
}

/// Of texels -1..size.
template <class B>
typename B::I texelAt(typename B::I texel, std::int32_t size, TextureWrap wrap) {
  if (wrap == TextureWrap::repeat)
    texel = texel + B::when(B::greater(B::seti(0), texel), B::seti(size)) -
            B::when(B::greater(texel, B::seti(size - 1)), B::seti(size));
  return clampTo<B>(texel, 0, size - 1);
}

template <class B>
[[gnu::always_inline]] inline Colours<B> decoded(const SurfaceShade& s, typename B::I texel) {
  const typename B::I byte = B::seti(0xff);
  return {B::lookUp256(s.linearFromSrgb, B::both(texel, byte)),
          B::lookUp256(s.linearFromSrgb, B::both(B::template shiftRight<8>(texel), byte)),
          B::lookUp256(s.linearFromSrgb, B::both(B::template shiftRight<16>(texel), byte))};
}

template <class B>
[[gnu::always_inline]] inline Colours<B> textureAt(const SurfaceShade& s, typename B::F u, typename B::F v) {
  using F = typename B::F;
  using I = typename B::I;
  const F x = wrapped<B>(u, s.wrapU) * B::set(static_cast<float>(s.width));
  const F y = wrapped<B>(v, s.wrapV) * B::set(static_cast<float>(s.height));
  const auto at = [&](I column, I row) {
    return decoded<B>(s, B::gather(s.texels, B::times(row, B::seti(s.width)) + column));
  };
  if (s.nearest)
    return at(clampTo<B>(B::truncate(x), 0, s.width - 1), clampTo<B>(B::truncate(y), 0, s.height - 1));
  const F left = B::floorOf(x - B::set(0.5f)), top = B::floorOf(y - B::set(0.5f));
  const F shareX = x - B::set(0.5f) - left, shareY = y - B::set(0.5f) - top;
  const I first = B::truncate(left), upper = B::truncate(top);
  const I x0 = texelAt<B>(first, s.width, s.wrapU), x1 = texelAt<B>(first + B::seti(1), s.width, s.wrapU);
  const I y0 = texelAt<B>(upper, s.height, s.wrapV), y1 = texelAt<B>(upper + B::seti(1), s.height, s.wrapV);
  const Colours<B> c00 = at(x0, y0), c10 = at(x1, y0), c01 = at(x0, y1), c11 = at(x1, y1);
  Colours<B> colours;
  for (int i = 0; i < 3; ++i)
    colours.channel[i] = mix<B>(mix<B>(c00.channel[i], c10.channel[i], shareX),
                                mix<B>(c01.channel[i], c11.channel[i], shareX), shareY);
  return colours;
}

/// surfaceCellAt and the three samples that it names.
template <class B>
[[gnu::always_inline]] inline Colours<B> lightAt(const SurfaceShade& s, typename B::F b1, typename B::F b2) {
  using F = typename B::F;
  using I = typename B::I;
  using M = typename B::M;
  const F r = B::set(static_cast<float>(s.resolution)), zero = B::set(0), one = B::set(1);
  F x = clampToUnit<B>(b1) * r, y = clampToUnit<B>(b2) * r;
  const F excess = x + y - r;
  const M beyond = B::less(zero, excess);
  x = B::select(beyond, B::max(zero, x - B::set(0.5f) * excess), x);
  y = B::select(beyond, B::min(B::max(zero, y - B::set(0.5f) * excess), r - x), y);
  const I last = B::seti(s.resolution - 1);
  I i = clampTo<B>(B::truncate(x), 0, s.resolution - 1), j = clampTo<B>(B::truncate(y), 0, s.resolution - 1);
  const M outside = B::greater(i + j, last), iIsLarger = B::greater(i, j);  // the last whole cell
  const I shorterI = B::select(iIsLarger, last - j, i), shorterJ = B::select(iIsLarger, j, last - i);
  i = B::select(outside, shorterI, i), j = B::select(outside, shorterJ, j);
  const F fx = x - B::toFloat(i), fy = y - B::toFloat(j);
  const M lower = B::notLess(one, fx + fy) | B::greater(i + j + B::seti(2), B::seti(s.resolution));
  const F weights[3] = {B::select(lower, one - fx - fy, fx + fy - one), B::select(lower, fx, one - fy),
                        B::select(lower, fy, one - fx)};
  const auto start = [&](I row) {  // of samples (row, 0...)
    return B::times(row, B::seti(s.resolution + 1)) -
           B::template shiftRight<1>(B::times(row, row - B::seti(1)));
  };
  const I onI = start(i) + j, onNext = start(i + B::seti(1)) + j;
  const I samples[3] = {B::select(lower, onI, onNext + B::seti(1)), onNext, onI + B::seti(1)};
  Colours<B> sum{zero, zero, zero};
  for (int c = 0; c < 3; ++c) {
    I redGreen, blue;
    B::gatherPairs(s.light, samples[c], redGreen, blue);
    const I channel[3] = {redGreen, B::template shiftRight<16>(redGreen), blue};
    for (int k = 0; k < 3; ++k)
      sum.channel[k] = sum.channel[k] + weights[c] * B::fromHalf(B::both(channel[k], B::seti(0xffff)));
  }
  return sum;
}

template <class B>
typename B::F usable(typename B::F radiance) {
  return B::min(B::max(radiance, B::set(0)), B::set(tone_curve::kBrightest));
}

/// toneMap.
template <class B>
[[gnu::always_inline]] inline Colours<B> toneMapped(Colours<B> radiance, float exposure) {
  using F = typename B::F;
  F* const c = radiance.channel;
  for (int k = 0; k < 3; ++k) c[k] = usable<B>(c[k] * B::set(exposure));
  const F peak = B::max(B::max(c[0], c[1]), c[2]);
  const typename B::M bright = B::less(B::set(tone_curve::kShoulderStart), peak);
  if (!B::any(bright)) return radiance;
  constexpr float room = 1 - tone_curve::kShoulderStart;
  const F mappedPeak =
      B::set(1) - B::set(room * room) / (peak - B::set(tone_curve::kShoulderStart) + B::set(room));
  const F scale = mappedPeak / peak;
  const F keep = B::set(1) / (B::set(tone_curve::kHighlightDesaturation) * (peak - mappedPeak) + B::set(1));
  for (int k = 0; k < 3; ++k) {
    const F mixed = mappedPeak + (c[k] * scale - mappedPeak) * keep;
    c[k] = B::select(bright, clampToUnit<B>(mixed), c[k]);
  }
  return radiance;
}

/// srgbCodeFromLinear.
template <class B>
[[gnu::always_inline]] inline typename B::I codeOf(const SurfaceShade& s, typename B::F linear) {
  const typename B::F inside = clampToUnit<B>(linear);
  const typename B::I code =
      B::gather(s.firstCode, B::truncate(inside * B::set(static_cast<float>(tone_curve::kCodeBuckets))));
  const typename B::F next = B::lookUp256(s.threshold + 1, code);
  return code + B::when(B::notLess(inside, next), B::seti(1));
}

/// The edge functions of a batch of pixels from column x on.
template <class B>
struct EdgeValues {
  typename B::D value[3], sum;

  template <class Row>
  EdgeValues(const Row& row, std::int32_t x) {
    const typename B::D column = B::toDouble(B::counted(x));
    for (int i = 0; i < 3; ++i) value[i] = B::setd(row.slope[i]) * column + B::setd(row.start[i]);
    sum = value[0] + value[1] + value[2];
  }
  /// Of the pixels that the triangle covers, at these inverse depths.
  typename B::M covered(const EdgeRow& row, typename B::D inverse) const {
    const typename B::D zero = B::setd(0);
    typename B::M inside = B::less(zero, inverse) & B::notLess(B::setd(row.mostInverse), inverse);
    for (int i = 0; i < 3; ++i)
      inside = inside & (row.ownsBorder[i] ? B::notLess(value[i], zero) : B::less(zero, value[i]));
    return inside;
  }
};

/// Weights of the corners at a batch of pixels.
template <class B>
struct Weights {
  typename B::F weight[3];

  explicit Weights(const EdgeValues<B>& edges) {
    const typename B::D perSum = B::setd(1) / edges.sum;
    for (int i = 0; i < 3; ++i) weight[i] = B::toFloat(edges.value[i] * perSum);
  }
  template <int kAxes>
  typename B::F mean(const float (&at)[3][kAxes], int axis) const {
    return B::set(at[0][axis]) * weight[0] + B::set(at[1][axis]) * weight[1] +
           B::set(at[2][axis]) * weight[2];
  }
};

template <class B>
void multiply(Colours<B>& colours, const Colours<B>& by) {
  for (int k = 0; k < 3; ++k) colours.channel[k] = colours.channel[k] * by.channel[k];
}

template <class B>
[[gnu::always_inline]] inline Colours<B> baseColourAt(const SurfaceShade& s, const Weights<B>& weights) {
  Colours<B> base{B::set(s.colour[0]), B::set(s.colour[1]), B::set(s.colour[2])};
  if (s.texels != nullptr) multiply<B>(base, textureAt<B>(s, weights.mean(s.uv, 0), weights.mean(s.uv, 1)));
  return base;
}

/// The display codes of what has this base colour.
template <class B>
struct Codes {
  typename B::I channel[3];

  [[gnu::always_inline]] Codes(const SurfaceShade& s, const Weights<B>& weights, Colours<B> radiance) {
    if (s.light != nullptr)
      multiply<B>(radiance, s.resolution > 0 ? lightAt<B>(s, weights.mean(s.barycentric, 0),
                                                          weights.mean(s.barycentric, 1))
                                             : Colours<B>{B::set(0), B::set(0), B::set(0)});
    for (int k = 0; k < 3; ++k) radiance.channel[k] = radiance.channel[k] + B::set(s.emission[k]);
    const Colours<B> display = toneMapped<B>(radiance, s.exposure);
    for (int k = 0; k < 3; ++k) channel[k] = codeOf<B>(s, display.channel[k]);
  }
};

/// Opaque pixels.
template <class B>
typename B::I pixelsOf(const typename B::I (&channel)[3]) {
  return channel[0] + B::template shiftLeft<8>(channel[1]) + B::template shiftLeft<16>(channel[2]) +
         B::seti(-0x1000000);
}

template <class B>
void shadeRun(const SurfaceShade& shade, const SurfaceRun& run) {
  const SurfaceShade s = shade;  // copies that no pixel is written over: they stay in registers
  const SurfaceRun r = run;
  for (std::int32_t done = 0; done < r.count; done += B::kWidth) {
    const std::int32_t count = r.count - done;
    const EdgeValues<B> edges(r, r.x0 + done);
    const Weights<B> weights(edges);
    const Codes<B> codes(s, weights, baseColourAt<B>(s, weights));
    B::store(r.colour + done, pixelsOf<B>(codes.channel), count);
    B::store(r.inverseZDepth + done, B::toFloat(edges.sum * B::setd(r.perDepth)), count);
  }
}

/// glassAlpha(...).alpha(); the power is multiplied out.
template <class B>
typename B::F glassAlphaAt(const ClearShade& s, const Weights<B>& weights, const Colours<B>& base) {
  using F = typename B::F;
  const F one = B::set(1);
  F dot = B::set(0), normals = B::set(0), ways = B::set(0);
  for (int axis = 0; axis < 3; ++axis) {
    const F normal = weights.mean(s.normal, axis), way = weights.mean(s.toEye, axis);
    dot = dot + normal * way, normals = normals + normal * normal, ways = ways + way * way;
  }
  const F lengths = B::sqrt(normals * ways);
  const F cosine = B::select(B::less(B::set(0), lengths), B::abs(dot) / lengths, one);
  const F grazing = one - clampToUnit<B>(cosine), square = grazing * grazing;
  const F fresnel = B::set(0.04f) + B::set(0.96f) * (square * square * grazing);
  const F film = B::min(one, B::set(0.08f) + fresnel);
  const F luminance = base.channel[0] * B::set(0.2126f) + base.channel[1] * B::set(0.7152f) +
                      base.channel[2] * B::set(0.0722f);
  const F passing = clampToUnit<B>(B::set(s.transmission) * luminance);
  return film + (one - film) * (one - passing);
}

/// blendOver, where the edges and what is there before let it be seen.
template <class B>
void blendRow(const ClearShade& s, const ClearRow& r) {
  using F = typename B::F;
  using I = typename B::I;
  using M = typename B::M;
  const I byte = B::seti(0xff);
  for (std::int32_t done = 0; done < r.count; done += B::kWidth) {
    const std::int32_t count = r.count - done;
    const EdgeValues<B> edges(r, r.x0 + done);
    const typename B::D inverse = edges.sum * B::setd(r.perDepth);
    const I source = B::load(r.source + done, count);
    const M inFront = B::less(B::load(r.nearest + done, count), B::toFloat(inverse));
    const M seen = edges.covered(r, inverse) & B::greater(source, B::seti(r.hole)) &
                   (inFront | B::greater(B::seti(r.local), source));
    if (!B::any(seen)) continue;
    const Weights<B> weights(edges);
    const Colours<B> base = baseColourAt<B>(s.surface, weights);
    F alpha = B::set(s.opacity);
    if (s.glass) alpha = alpha * glassAlphaAt<B>(s, weights, base);
    const I alphaCode = B::truncate(clampToUnit<B>(alpha) * B::set(255) + B::set(0.5f));
    const F share = B::toFloat(alphaCode) / B::set(255);
    const Codes<B> over(s.surface, weights, base);
    const I before = B::load(r.colour + done, count);
    const I under[3] = {B::both(before, byte), B::both(B::template shiftRight<8>(before), byte),
                        B::both(B::template shiftRight<16>(before), byte)};
    I mixed[3];
    for (int k = 0; k < 3; ++k) {
      const F low = B::lookUp256(s.surface.linearFromSrgb, under[k]);
      const F high = B::lookUp256(s.surface.linearFromSrgb, over.channel[k]);
      mixed[k] = codeOf<B>(s.surface, low + (high - low) * share);
    }
    B::store(r.colour + done, B::select(seen, pixelsOf<B>(mixed), before), count);
  }
}

template <class B>
void coverRow(const TriangleRow& r) {
  using F = typename B::F;
  using I = typename B::I;
  for (std::int32_t done = 0; done < r.count; done += B::kWidth) {
    const std::int32_t count = r.count - done;
    const EdgeValues<B> edges(r, r.x0 + done);
    const typename B::D inverse = edges.sum * B::setd(r.perDepth);
    const F depth = B::toFloat(inverse), before = B::load(r.nearest + done, count);
    const typename B::M seen = edges.covered(r, inverse) & B::less(before, depth);
    if (!B::any(seen)) continue;
    const I own = B::seti(static_cast<std::int32_t>(r.triangle));
    B::store(r.nearest + done, B::select(seen, depth, before), count);
    B::store(r.visible + done, B::select(seen, own, B::load(r.visible + done, count)), count);
  }
}

}  // namespace acentric::surface_kernel
