#if defined(__x86_64__)
#include "engine/view/lanes_avx512.h"
#include "engine/view/warp_kernel_body.h"

namespace acentric {
namespace {

struct WarpLanes : SixteenLanes {
  using SixteenLanes::load;
  static void load(const PackedSample* p, I& inverseAndRoles, I& rowAndSlant) {
    const __m512i first = _mm512_loadu_si512(p), second = _mm512_loadu_si512(p + 8);
    const __m512i even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
    inverseAndRoles = {_mm512_permutex2var_epi32(first, even, second)};
    rowAndSlant = {_mm512_permutex2var_epi32(first, (I{even} + seti(1)).v, second)};
  }
  static F tangents(const float* table, const PackedSample* rising, I rowAndSlant) {
    const I row = both(rowAndSlant, seti(0xffff));
    const unsigned first = rising[0].row, span = rising[kWidth - 1].row - first;
    if (span >= kWidth) return gather(table, row);
    const __m512 near = _mm512_maskz_loadu_ps(static_cast<__mmask16>((2u << span) - 1), table + first);
    return {_mm512_permutexvar_ps((row - seti(static_cast<int>(first))).v, near)};
  }
  static M needed(const std::uint8_t* roles, std::uint32_t wanted) {
    const __m128i narrow = _mm_loadu_si128(reinterpret_cast<const __m128i*>(roles));
    return {_mm_test_epi8_mask(narrow, _mm_set1_epi8(static_cast<char>(wanted)))};
  }
  static M needed(I roles, std::uint32_t wanted) {
    return {_mm512_test_epi32_mask(roles.v, seti(static_cast<int>(wanted)).v)};
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
  return warp_kernel::projectColumn<WarpLanes>(column, samples, runs, runCount, out);
}

int findBlocksAvx512(const ProjectColumn& column, const BlockTest& test, const BlockColumn& blocks, int count,
                     std::uint16_t* out) {
  return warp_kernel::findBlocks<WarpLanes>(column, test, blocks, count, out);
}

}  // namespace acentric
#endif
