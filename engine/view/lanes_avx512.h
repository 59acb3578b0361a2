#pragma once
/// Sixteen lanes, for AVX-512 (x86-64-v4): see lanes_scalar.h.

#include <immintrin.h>

#include <cstdint>

namespace acentric {
namespace {

struct Floats {
  __m512 v;
  friend Floats operator+(Floats a, Floats b) { return {_mm512_add_ps(a.v, b.v)}; }
  friend Floats operator-(Floats a, Floats b) { return {_mm512_sub_ps(a.v, b.v)}; }
  friend Floats operator*(Floats a, Floats b) { return {_mm512_mul_ps(a.v, b.v)}; }
  friend Floats operator/(Floats a, Floats b) { return {_mm512_div_ps(a.v, b.v)}; }
};

struct Doubles {
  __m512d low, high;
  friend Doubles operator+(Doubles a, Doubles b) {
    return {_mm512_add_pd(a.low, b.low), _mm512_add_pd(a.high, b.high)};
  }
  friend Doubles operator*(Doubles a, Doubles b) {
    return {_mm512_mul_pd(a.low, b.low), _mm512_mul_pd(a.high, b.high)};
  }
  friend Doubles operator/(Doubles a, Doubles b) {
    return {_mm512_div_pd(a.low, b.low), _mm512_div_pd(a.high, b.high)};
  }
};

struct Ints {
  __m512i v;
  friend Ints operator+(Ints a, Ints b) { return {_mm512_add_epi32(a.v, b.v)}; }
  friend Ints operator-(Ints a, Ints b) { return {_mm512_sub_epi32(a.v, b.v)}; }
};

struct Mask {
  __mmask16 v;
  friend Mask operator&(Mask a, Mask b) { return {_kand_mask16(a.v, b.v)}; }
  friend Mask operator|(Mask a, Mask b) { return {_kor_mask16(a.v, b.v)}; }
};

struct SixteenLanes {
  static constexpr int kWidth = 16;
  using F = Floats;
  using D = Doubles;
  using I = Ints;
  using M = Mask;
  static F set(float value) { return {_mm512_set1_ps(value)}; }
  static D setd(double value) { return {_mm512_set1_pd(value), _mm512_set1_pd(value)}; }
  static I seti(std::int32_t value) { return {_mm512_set1_epi32(value)}; }
  static I counted(std::int32_t first) {
    return {_mm512_add_epi32(_mm512_set1_epi32(first),
                             _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))};
  }
  static F load(const float* p) { return {_mm512_loadu_ps(p)}; }
  static __mmask16 firstLanes(int count) {
    return static_cast<__mmask16>(count >= kWidth ? 0xffffu : (1u << count) - 1);
  }
  static F load(const float* p, int count) { return {_mm512_maskz_loadu_ps(firstLanes(count), p)}; }
  static I load(const std::uint32_t* p, int count) {
    return {_mm512_maskz_loadu_epi32(firstLanes(count), p)};
  }
  static I load(const std::uint16_t* p, int count) {
    return {_mm512_cvtepu16_epi32(_mm256_maskz_loadu_epi16(firstLanes(count), p))};
  }
  static void store(float* p, F a, int count) { _mm512_mask_storeu_ps(p, firstLanes(count), a.v); }
  static void store(std::uint32_t* p, I a, int count) { _mm512_mask_storeu_epi32(p, firstLanes(count), a.v); }

  static M less(F a, F b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ)}; }
  static M notLess(F a, F b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_GE_OQ)}; }
  static Mask together(__mmask8 low, __mmask8 high) { return {_mm512_kunpackb(high, low)}; }
  static M less(D a, D b) {
    return together(_mm512_cmp_pd_mask(a.low, b.low, _CMP_LT_OQ),
                    _mm512_cmp_pd_mask(a.high, b.high, _CMP_LT_OQ));
  }
  static M notLess(D a, D b) {
    return together(_mm512_cmp_pd_mask(a.low, b.low, _CMP_GE_OQ),
                    _mm512_cmp_pd_mask(a.high, b.high, _CMP_GE_OQ));
  }
  static M greater(I a, I b) { return {_mm512_cmpgt_epi32_mask(a.v, b.v)}; }
  static bool any(M m) { return m.v != 0; }
  static unsigned bits(M m) { return m.v; }
  static F select(M m, F a, F b) { return {_mm512_mask_blend_ps(m.v, b.v, a.v)}; }
  static I select(M m, I a, I b) { return {_mm512_mask_blend_epi32(m.v, b.v, a.v)}; }
  static I when(M m, I a) { return {_mm512_maskz_mov_epi32(m.v, a.v)}; }

  static F abs(F a) { return {_mm512_abs_ps(a.v)}; }
  static F sqrt(F a) { return {_mm512_sqrt_ps(a.v)}; }
  static F min(F a, F b) { return {_mm512_min_ps(a.v, b.v)}; }
  static F max(F a, F b) { return {_mm512_max_ps(a.v, b.v)}; }
  static I times(I a, I b) { return {_mm512_mullo_epi32(a.v, b.v)}; }
  static I mini(I a, I b) { return {_mm512_min_epi32(a.v, b.v)}; }
  static I maxi(I a, I b) { return {_mm512_max_epi32(a.v, b.v)}; }
  template <int kBits>
  static I shiftRight(I a) {
    return {_mm512_srli_epi32(a.v, kBits)};
  }
  template <int kBits>
  static I shiftLeft(I a) {
    return {_mm512_slli_epi32(a.v, kBits)};
  }
  static I both(I a, I b) { return {_mm512_and_si512(a.v, b.v)}; }
  static I different(I a, I b) { return {_mm512_xor_si512(a.v, b.v)}; }
  static I asInts(F bits) { return {_mm512_castps_si512(bits.v)}; }

  static F asFloat(I bits) { return {_mm512_castsi512_ps(bits.v)}; }
  static F toFloat(I a) { return {_mm512_cvtepi32_ps(a.v)}; }
  static F toFloat(D a) {
    return {_mm512_insertf32x8(_mm512_castps256_ps512(_mm512_cvtpd_ps(a.low)), _mm512_cvtpd_ps(a.high), 1)};
  }
  static D toDouble(I a) {
    return {_mm512_cvtepi32_pd(_mm512_castsi512_si256(a.v)),
            _mm512_cvtepi32_pd(_mm512_extracti64x4_epi64(a.v, 1))};
  }
  static I truncate(F a) { return {_mm512_cvttps_epi32(a.v)}; }
  static F floorOf(F a) { return {_mm512_roundscale_ps(a.v, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC)}; }
  static F fromHalf(I half) { return {_mm512_cvtph_ps(_mm512_cvtepi32_epi16(half.v))}; }

  static I gather(const std::uint32_t* table, I index) { return {_mm512_i32gather_epi32(index.v, table, 4)}; }
  static F gather(const float* table, I index) { return {_mm512_i32gather_ps(index.v, table, 4)}; }
  /// Shuffles cost a third of what gathers do.
  static F lookUp256(const float* table, I index) {
    const auto among = [&](int first) {
      return _mm512_permutex2var_ps(_mm512_loadu_ps(table + first), index.v,
                                    _mm512_loadu_ps(table + first + 16));
    };
    const __m512i part = _mm512_srli_epi32(index.v, 5);
    __m512 found = among(0);
    for (int i = 1; i < 8; ++i)
      found = _mm512_mask_mov_ps(found, _mm512_cmpeq_epi32_mask(part, _mm512_set1_epi32(i)), among(32 * i));
    return {found};
  }
  static I gather(const std::uint8_t* table, I index) {
    return both({_mm512_i32gather_epi32(index.v, table, 1)}, seti(0xff));
  }
  static void gatherPairs(const std::uint32_t* table, I index, I& first, I& second) {
    first = {_mm512_i32gather_epi32(index.v, table, 8)};
    second = {_mm512_i32gather_epi32(index.v, table + 1, 8)};
  }

  /// Words that alternate.
  static void separate(__m512i first, __m512i second, I& even, I& odd) {
    const I lanes{_mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30)};
    even = {_mm512_permutex2var_epi32(first, lanes.v, second)};
    odd = {_mm512_permutex2var_epi32(first, (lanes + seti(1)).v, second)};
  }
  static void loadPairs(const std::uint64_t* p, int count, I& low, I& high) {
    const __m512i first = _mm512_maskz_loadu_epi64(__mmask8(firstLanes(count)), p);
    const __m512i second = _mm512_maskz_loadu_epi64(__mmask8(firstLanes(count) >> 8), p + 8);
    separate(first, second, low, high);
  }
  static void storePairs(std::uint64_t* p, I low, I high, int count) {
    const __m512i lanes = _mm512_setr_epi32(0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
    _mm512_mask_storeu_epi64(p, __mmask8(firstLanes(count)), _mm512_permutex2var_epi32(low.v, lanes, high.v));
    _mm512_mask_storeu_epi64(p + 8, __mmask8(firstLanes(count) >> 8),
                             _mm512_permutex2var_epi32(low.v, (I{lanes} + seti(8)).v, high.v));
  }
};

}  // namespace
}  // namespace acentric
