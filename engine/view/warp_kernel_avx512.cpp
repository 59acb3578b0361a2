#if defined(__x86_64__)
#include "engine/view/lanes_avx512.h"
#include "engine/view/warp_kernel_body.h"

namespace acentric {
namespace {

struct WarpLanes : SixteenLanes {
  using SixteenLanes::load;
  static void load(const PackedSample* p, I& inverseAndRoles, I& row) {
    const __m512i first = _mm512_loadu_si512(p), second = _mm512_loadu_si512(p + 8);
    const __m512i even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
    inverseAndRoles = {_mm512_permutex2var_epi32(first, even, second)};
    row = {_mm512_permutex2var_epi32(first, (I{even} + seti(1)).v, second)};
  }
  static I words(const unsigned char* p, int count) {
    return load(reinterpret_cast<const std::uint32_t*>(p), count);
  }
  static F tangents(const float* table, const PackedSample* rising, I row) {
    const unsigned first = rising[0].row, span = rising[kWidth - 1].row - first;
    if (span >= kWidth) return gather(table, row);
    const __m512 near = _mm512_maskz_loadu_ps(static_cast<__mmask16>((2u << span) - 1), table + first);
    return {_mm512_permutexvar_ps((row - seti(static_cast<int>(first))).v, near)};
  }
  static M needed(I roles, std::uint32_t wanted) {
    return {_mm512_test_epi32_mask(roles.v, seti(static_cast<int>(wanted)).v)};
  }
  static M kept(M accepted) { return accepted; }
  /// Those lanes first, one after the other; zeros behind them.
  static I together(M kept, I lanes) { return {_mm512_maskz_compress_epi32(kept.v, lanes.v)}; }
  static void storeAll(std::uint32_t* p, I a) { _mm512_storeu_si512(p, a.v); }
};

}  // namespace

int projectSamplesAvx512(const ProjectColumn& column, const SampleColumn& samples, std::uint32_t count,
                         const SplatArrays& out) {
  return warp_kernel::projectColumn<WarpLanes>(column, samples, count, out);
}

}  // namespace acentric
#endif
