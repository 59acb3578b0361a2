#if defined(__x86_64__)
#include "engine/view/lanes_avx512.h"
#include "engine/view/patch_kernel_body.h"

namespace acentric {
namespace {

struct PatchLanes : SixteenLanes {
  static I shiftRightBy(I a, I bits) { return {_mm512_srlv_epi32(a.v, bits.v)}; }
  static I shiftLeftBy(I a, int bits) { return {_mm512_sll_epi32(a.v, _mm_cvtsi32_si128(bits))}; }
  static void loadPairs(const std::uint64_t* p, int count, I& low, I& high) {
    const __m512i first = _mm512_maskz_loadu_epi64(__mmask8(firstLanes(count)), p);
    const __m512i second = _mm512_maskz_loadu_epi64(__mmask8(firstLanes(count) >> 8), p + 8);
    const __m512i even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
    low = {_mm512_permutex2var_epi32(first, even, second)};
    high = {_mm512_permutex2var_epi32(first, _mm512_add_epi32(even, _mm512_set1_epi32(1)), second)};
  }
  static void storePairs(std::uint64_t* p, I low, I high, int count) {
    const __m512i first = _mm512_setr_epi32(0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
    _mm512_mask_storeu_epi64(p, __mmask8(firstLanes(count)), _mm512_permutex2var_epi32(low.v, first, high.v));
    const __m512i second = _mm512_add_epi32(first, _mm512_set1_epi32(8));
    _mm512_mask_storeu_epi64(p + 8, __mmask8(firstLanes(count) >> 8),
                             _mm512_permutex2var_epi32(low.v, second, high.v));
  }
};

}  // namespace

const PatchKernel kPatchKernelAvx512 = patch_kernel::kVariant<PatchLanes>;

}  // namespace acentric
#endif
