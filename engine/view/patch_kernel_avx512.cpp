#if defined(__x86_64__)
#include "engine/view/lanes_avx512.h"
#include "engine/view/patch_kernel_body.h"

namespace acentric {
namespace {

struct PatchLanes : SixteenLanes {
  static std::int32_t lowest(I a) { return _mm_cvtsi128_si32(_mm512_castsi512_si128(a.v)); }
  static I shiftRightBy(I a, I bits) { return {_mm512_srlv_epi32(a.v, bits.v)}; }
  static I shiftLeftBy(I a, int bits) { return {_mm512_slli_epi32(a.v, static_cast<unsigned>(bits))}; }
  /// Words at the index and behind it: half as many loads as two gathers.
  static void gatherNext(const std::uint32_t* table, I index, I& at, I& next) {
    const __m512i low = _mm512_i32gather_epi64(_mm512_castsi512_si256(index.v), table, 4);
    const __m512i high = _mm512_i32gather_epi64(_mm512_extracti64x4_epi64(index.v, 1), table, 4);
    separate(low, high, at, next);
  }
  /// The second one only where eight lanes hold the first.
  static F inHalves(float first, float second) {
    return {_mm512_mask_mov_ps(_mm512_set1_ps(first), 0xff00, _mm512_set1_ps(second))};
  }
};

}  // namespace

const PatchKernel kPatchKernelAvx512 = patch_kernel::kVariant<PatchLanes>;

}  // namespace acentric
#endif
