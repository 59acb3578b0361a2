#if defined(__x86_64__)
#include <immintrin.h>

#include "engine/view/warp_kernel_body.h"

namespace acentric {
namespace {

struct Floats {
  __m512 v;
  friend Floats operator+(Floats a, Floats b) { return {_mm512_add_ps(a.v, b.v)}; }
  friend Floats operator-(Floats a, Floats b) { return {_mm512_sub_ps(a.v, b.v)}; }
  friend Floats operator*(Floats a, Floats b) { return {_mm512_mul_ps(a.v, b.v)}; }
  friend Floats operator/(Floats a, Floats b) { return {_mm512_div_ps(a.v, b.v)}; }
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
  using I = Ints;
  using M = Mask;
  static F set(float value) { return {_mm512_set1_ps(value)}; }
  static I seti(std::int32_t value) { return {_mm512_set1_epi32(value)}; }
  static F load(const float* p) { return {_mm512_loadu_ps(p)}; }
  static F gather(const float* table, const std::uint16_t* rising) {
    const __m512i index = _mm512_cvtepu16_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(rising)));
    const unsigned first = rising[0], span = rising[kWidth - 1] - first;
    if (span >= kWidth) return {_mm512_i32gather_ps(index, table, 4)};
    const __m512 near = _mm512_maskz_loadu_ps(static_cast<__mmask16>((2u << span) - 1), table + first);
    return {_mm512_permutexvar_ps(_mm512_sub_epi32(index, _mm512_set1_epi32(static_cast<int>(first))), near)};
  }
  static M needed(const std::uint8_t* roles, std::uint32_t wanted) {
    const __m128i narrow = _mm_loadu_si128(reinterpret_cast<const __m128i*>(roles));
    return {_mm_test_epi8_mask(narrow, _mm_set1_epi8(static_cast<char>(wanted)))};
  }
  static M less(F a, F b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ)}; }
  static M notLess(F a, F b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_GE_OQ)}; }
  static M greater(I a, I b) { return {_mm512_cmpgt_epi32_mask(a.v, b.v)}; }
  static unsigned bits(M m) { return m.v; }
  static M either(M a, M unlessB) { return {static_cast<__mmask16>(a.v | ~unlessB.v)}; }
  static bool any(M m) { return m.v != 0; }
  static F abs(F a) { return {_mm512_abs_ps(a.v)}; }
  static F sqrt(F a) { return {_mm512_sqrt_ps(a.v)}; }
  static F min(F a, F b) { return {_mm512_min_ps(a.v, b.v)}; }
  static F max(F a, F b) { return {_mm512_max_ps(a.v, b.v)}; }
  static F select(M m, F a, F b) { return {_mm512_mask_blend_ps(m.v, b.v, a.v)}; }
  static F toFloat(I a) { return {_mm512_cvtepi32_ps(a.v)}; }
  static I floor(F a) {
    return {_mm512_cvttps_epi32(_mm512_roundscale_ps(a.v, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC))};
  }
  static I ceil(F a) {
    return {_mm512_cvttps_epi32(_mm512_roundscale_ps(a.v, _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC))};
  }
  static I gather(const std::uint32_t* table, I index) { return {_mm512_i32gather_epi32(index.v, table, 4)}; }
  static I when(M m, I a) { return {_mm512_maskz_mov_epi32(m.v, a.v)}; }
  static I times(I a, I b) { return {_mm512_mullo_epi32(a.v, b.v)}; }
  static I mini(I a, I b) { return {_mm512_min_epi32(a.v, b.v)}; }
  static I maxi(I a, I b) { return {_mm512_max_epi32(a.v, b.v)}; }
  static void slants(const Slant* p, F& across, F& down) {
    static_assert(sizeof(Slant) == 2);
    const __m512i both = _mm512_cvtepi16_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p)));
    const auto tangent = [](__m512i code) {
      const F size = toFloat({code});
      return size / (set(127) - abs(size));
    };
    across = tangent(_mm512_srai_epi32(_mm512_slli_epi32(both, 24), 24));
    down = tangent(_mm512_srai_epi32(both, 8));
  }
  static I pack(I width, I height, I placeX, I placeY) {
    const __m512i size = _mm512_or_si512(width.v, _mm512_slli_epi32(height.v, 8));
    const __m512i place = _mm512_or_si512(placeX.v, _mm512_slli_epi32(placeY.v, 8));
    return {_mm512_or_si512(size, _mm512_slli_epi32(place, 16))};
  }

  /// Moves the accepted splats together and writes sixteen, however many those are.
  static int append(M accepted, I x, I y, I size, std::uint32_t index, I spread, F inverseZDepth,
                    Splat* out) {
    if (accepted.v == 0) return 0;
    const auto together = [&](__m512i lanes) { return _mm512_maskz_compress_epi32(accepted.v, lanes); };
    const __m512i xy = together(_mm512_mask_blend_epi16(0xaaaaaaaa, x.v, _mm512_slli_epi32(y.v, 16)));
    const __m512i counted =
        _mm512_add_epi32(_mm512_set1_epi32(static_cast<int>(index)),
                         _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
    const __m512i indices = together(_mm512_or_si512(counted, _mm512_slli_epi32(spread.v, 28)));
    const __m512i sizes = together(size.v), depth = together(_mm512_castps_si512(inverseZDepth.v));
    const __m512i low01 = _mm512_unpacklo_epi32(xy, sizes), high01 = _mm512_unpackhi_epi32(xy, sizes);
    const __m512i low23 = _mm512_unpacklo_epi32(indices, depth),
                  high23 = _mm512_unpackhi_epi32(indices, depth);
    // Splats 0 4 8 12, 1 5 9 13, ...: the four lanes of each.
    const __m512i a = _mm512_unpacklo_epi64(low01, low23), b = _mm512_unpackhi_epi64(low01, low23),
                  c = _mm512_unpacklo_epi64(high01, high23), d = _mm512_unpackhi_epi64(high01, high23);
    const __m512i abLow = _mm512_shuffle_i32x4(a, b, 0x44), abHigh = _mm512_shuffle_i32x4(a, b, 0xee),
                  cdLow = _mm512_shuffle_i32x4(c, d, 0x44), cdHigh = _mm512_shuffle_i32x4(c, d, 0xee);
    _mm512_storeu_si512(out, _mm512_shuffle_i32x4(abLow, cdLow, 0x88));
    _mm512_storeu_si512(out + 4, _mm512_shuffle_i32x4(abLow, cdLow, 0xdd));
    _mm512_storeu_si512(out + 8, _mm512_shuffle_i32x4(abHigh, cdHigh, 0x88));
    _mm512_storeu_si512(out + 12, _mm512_shuffle_i32x4(abHigh, cdHigh, 0xdd));
    return __builtin_popcount(accepted.v);
  }
};

}  // namespace

int projectSamplesAvx512(const ProjectColumn& column, const SampleColumn& samples, const SampleRun* runs,
                         int runCount, Splat* out) {
  return warp_kernel::projectColumn<SixteenLanes>(column, samples, runs, runCount, out);
}

int findBlocksAvx512(const ProjectColumn& column, const BlockTest& test, const BlockColumn& blocks, int count,
                     std::uint16_t* out) {
  return warp_kernel::findBlocks<SixteenLanes>(column, test, blocks, count, out);
}

}  // namespace acentric
#endif
