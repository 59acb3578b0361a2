#pragma once
/// Eight lanes, for AVX2 (x86-64-v3): see lanes_scalar.h.

#include <immintrin.h>

#include <cstdint>

namespace acentric {
namespace {

struct Floats {
  __m256 v;
  friend Floats operator+(Floats a, Floats b) { return {_mm256_add_ps(a.v, b.v)}; }
  friend Floats operator-(Floats a, Floats b) { return {_mm256_sub_ps(a.v, b.v)}; }
  friend Floats operator*(Floats a, Floats b) { return {_mm256_mul_ps(a.v, b.v)}; }
  friend Floats operator/(Floats a, Floats b) { return {_mm256_div_ps(a.v, b.v)}; }
};

struct Doubles {
  __m256d low, high;
  friend Doubles operator+(Doubles a, Doubles b) {
    return {_mm256_add_pd(a.low, b.low), _mm256_add_pd(a.high, b.high)};
  }
  friend Doubles operator*(Doubles a, Doubles b) {
    return {_mm256_mul_pd(a.low, b.low), _mm256_mul_pd(a.high, b.high)};
  }
  friend Doubles operator/(Doubles a, Doubles b) {
    return {_mm256_div_pd(a.low, b.low), _mm256_div_pd(a.high, b.high)};
  }
};

struct Ints {
  __m256i v;
  friend Ints operator+(Ints a, Ints b) { return {_mm256_add_epi32(a.v, b.v)}; }
  friend Ints operator-(Ints a, Ints b) { return {_mm256_sub_epi32(a.v, b.v)}; }
};

struct Mask {
  __m256 v;
  friend Mask operator&(Mask a, Mask b) { return {_mm256_and_ps(a.v, b.v)}; }
  friend Mask operator|(Mask a, Mask b) { return {_mm256_or_ps(a.v, b.v)}; }
};

struct EightLanes {
  static constexpr int kWidth = 8;
  using F = Floats;
  using D = Doubles;
  using I = Ints;
  using M = Mask;
  static F set(float value) { return {_mm256_set1_ps(value)}; }
  static D setd(double value) { return {_mm256_set1_pd(value), _mm256_set1_pd(value)}; }
  static I seti(std::int32_t value) { return {_mm256_set1_epi32(value)}; }
  static I counted(std::int32_t first) { return seti(first) + I{_mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7)}; }
  static F load(const float* p) { return {_mm256_loadu_ps(p)}; }
  static __m256i firstLanes(int count) { return _mm256_cmpgt_epi32(seti(count).v, counted(0).v); }
  // Where all lanes are wanted, no mask: some processors are slow with one.
  static F load(const float* p, int count) {
    return {count >= kWidth ? _mm256_loadu_ps(p) : _mm256_maskload_ps(p, firstLanes(count))};
  }
  static I load(const std::uint32_t* p, int count) {
    if (count >= kWidth) return {_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p))};
    return {_mm256_maskload_epi32(reinterpret_cast<const int*>(p), firstLanes(count))};
  }
  static I load(const std::uint16_t* p, int count) {
    alignas(16) std::uint16_t lanes[kWidth] = {};
    for (int i = 0; i < kWidth && i < count; ++i) lanes[i] = p[i];
    return {_mm256_cvtepu16_epi32(_mm_load_si128(reinterpret_cast<const __m128i*>(lanes)))};
  }
  static void store(float* p, F a, int count) {
    if (count >= kWidth) return _mm256_storeu_ps(p, a.v);
    _mm256_maskstore_ps(p, firstLanes(count), a.v);
  }
  static void store(std::uint32_t* p, I a, int count) {
    if (count >= kWidth) return _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), a.v);
    _mm256_maskstore_epi32(reinterpret_cast<int*>(p), firstLanes(count), a.v);
  }

  static M less(F a, F b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)}; }
  static M notLess(F a, F b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_GE_OQ)}; }
  static Mask together(__m256d low, __m256d high) {
    const __m256 mixed = _mm256_shuffle_ps(_mm256_castpd_ps(low), _mm256_castpd_ps(high), 0x88);
    return {_mm256_castpd_ps(_mm256_permute4x64_pd(_mm256_castps_pd(mixed), 0xd8))};
  }
  static M less(D a, D b) {
    return together(_mm256_cmp_pd(a.low, b.low, _CMP_LT_OQ), _mm256_cmp_pd(a.high, b.high, _CMP_LT_OQ));
  }
  static M notLess(D a, D b) {
    return together(_mm256_cmp_pd(a.low, b.low, _CMP_GE_OQ), _mm256_cmp_pd(a.high, b.high, _CMP_GE_OQ));
  }
  static M greater(I a, I b) { return {_mm256_castsi256_ps(_mm256_cmpgt_epi32(a.v, b.v))}; }
  static bool any(M m) { return _mm256_movemask_ps(m.v) != 0; }
  static unsigned bits(M m) { return static_cast<unsigned>(_mm256_movemask_ps(m.v)); }
  static F select(M m, F a, F b) { return {_mm256_blendv_ps(b.v, a.v, m.v)}; }
  static I select(M m, I a, I b) { return {_mm256_blendv_epi8(b.v, a.v, _mm256_castps_si256(m.v))}; }
  static I when(M m, I a) { return {_mm256_and_si256(_mm256_castps_si256(m.v), a.v)}; }

  static F abs(F a) { return {_mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.v)}; }
  static F sqrt(F a) { return {_mm256_sqrt_ps(a.v)}; }
  static F min(F a, F b) { return {_mm256_min_ps(a.v, b.v)}; }
  static F max(F a, F b) { return {_mm256_max_ps(a.v, b.v)}; }
  static I times(I a, I b) { return {_mm256_mullo_epi32(a.v, b.v)}; }
  static I mini(I a, I b) { return {_mm256_min_epi32(a.v, b.v)}; }
  static I maxi(I a, I b) { return {_mm256_max_epi32(a.v, b.v)}; }
  template <int kBits>
  static I shiftRight(I a) {
    return {_mm256_srli_epi32(a.v, kBits)};
  }
  template <int kBits>
  static I shiftLeft(I a) {
    return {_mm256_slli_epi32(a.v, kBits)};
  }
  static I both(I a, I b) { return {_mm256_and_si256(a.v, b.v)}; }
  static I different(I a, I b) { return {_mm256_xor_si256(a.v, b.v)}; }
  static I asInts(F bits) { return {_mm256_castps_si256(bits.v)}; }

  static F asFloat(I bits) { return {_mm256_castsi256_ps(bits.v)}; }
  static F toFloat(I a) { return {_mm256_cvtepi32_ps(a.v)}; }
  static F toFloat(D a) { return {_mm256_set_m128(_mm256_cvtpd_ps(a.high), _mm256_cvtpd_ps(a.low))}; }
  static D toDouble(I a) {
    return {_mm256_cvtepi32_pd(_mm256_castsi256_si128(a.v)),
            _mm256_cvtepi32_pd(_mm256_extracti128_si256(a.v, 1))};
  }
  static I truncate(F a) { return {_mm256_cvttps_epi32(a.v)}; }
  static F floorOf(F a) { return {_mm256_floor_ps(a.v)}; }
  static F fromHalf(I half) {
    const __m256i packed = _mm256_packus_epi32(both(half, seti(0xffff)).v, _mm256_setzero_si256());
    return {_mm256_cvtph_ps(_mm256_castsi256_si128(_mm256_permute4x64_epi64(packed, 0x08)))};
  }

  static I gather(const std::uint32_t* table, I index) {
    return {_mm256_i32gather_epi32(reinterpret_cast<const int*>(table), index.v, 4)};
  }
  static F gather(const float* table, I index) { return {_mm256_i32gather_ps(table, index.v, 4)}; }
  static F lookUp256(const float* table, I index) { return gather(table, index); }
  static I gather(const std::uint8_t* table, I index) {
    return both({_mm256_i32gather_epi32(reinterpret_cast<const int*>(table), index.v, 1)}, seti(0xff));
  }
  static void gatherPairs(const std::uint32_t* table, I index, I& first, I& second) {
    first = {_mm256_i32gather_epi32(reinterpret_cast<const int*>(table), index.v, 8)};
    second = {_mm256_i32gather_epi32(reinterpret_cast<const int*>(table + 1), index.v, 8)};
  }

  static __m256i firstPairs(int count) {
    return _mm256_cmpgt_epi64(_mm256_set1_epi64x(count), _mm256_setr_epi64x(0, 1, 2, 3));
  }
  /// Words that alternate.
  static void separate(__m256i first, __m256i second, I& even, I& odd) {
    const auto ordered = [](__m256 mixed) {
      return I{_mm256_permute4x64_epi64(_mm256_castps_si256(mixed), 0xd8)};
    };
    const __m256 a = _mm256_castsi256_ps(first), b = _mm256_castsi256_ps(second);
    even = ordered(_mm256_shuffle_ps(a, b, 0x88)), odd = ordered(_mm256_shuffle_ps(a, b, 0xdd));
  }
  static void loadPairs(const std::uint64_t* p, int count, I& low, I& high) {
    const auto* from = reinterpret_cast<const long long*>(p);
    const __m256i first = _mm256_maskload_epi64(from, firstPairs(count));
    const __m256i second = _mm256_maskload_epi64(from + 4, firstPairs(count - 4));
    separate(first, second, low, high);
  }
  static __m256i pairsOf(I low, I high, bool upper) {
    const __m256i first = _mm256_unpacklo_epi32(low.v, high.v), second = _mm256_unpackhi_epi32(low.v, high.v);
    return upper ? _mm256_permute2x128_si256(first, second, 0x31)
                 : _mm256_permute2x128_si256(first, second, 0x20);
  }
  static void storePairs(std::uint64_t* p, I low, I high, int count) {
    if (count >= kWidth) {
      __m256i* const all = reinterpret_cast<__m256i*>(p);
      _mm256_storeu_si256(all, pairsOf(low, high, false));
      return _mm256_storeu_si256(all + 1, pairsOf(low, high, true));
    }
    auto* const to = reinterpret_cast<long long*>(p);
    _mm256_maskstore_epi64(to, firstPairs(count), pairsOf(low, high, false));
    _mm256_maskstore_epi64(to + 4, firstPairs(count - 4), pairsOf(low, high, true));
  }
};

}  // namespace
}  // namespace acentric
