#if defined(__x86_64__)
#include "engine/view/lanes_avx2.h"
#include "engine/view/patch_kernel_body.h"

namespace acentric {
namespace {

struct PatchLanes : EightLanes {
  static std::int32_t lowest(I a) { return _mm_cvtsi128_si32(_mm256_castsi256_si128(a.v)); }
  static I shiftRightBy(I a, I bits) { return {_mm256_srlv_epi32(a.v, bits.v)}; }
  static I shiftLeftBy(I a, int bits) { return {_mm256_slli_epi32(a.v, bits)}; }
  /// Words at the index and behind it: half as many loads as two gathers.
  static void gatherNext(const std::uint32_t* table, I index, I& at, I& next) {
    const auto* const pairs = reinterpret_cast<const long long*>(table);
    const __m256i low = _mm256_i32gather_epi64(pairs, _mm256_castsi256_si128(index.v), 4);
    const __m256i high = _mm256_i32gather_epi64(pairs, _mm256_extracti128_si256(index.v, 1), 4);
    separate(low, high, at, next);
  }
  static F inHalves(float first, float) { return set(first); }
};

}  // namespace

const PatchKernel kPatchKernelAvx2 = patch_kernel::kVariant<PatchLanes>;

}  // namespace acentric
#endif
