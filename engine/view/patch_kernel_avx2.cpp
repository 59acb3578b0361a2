#if defined(__x86_64__)
#include "engine/view/lanes_avx2.h"
#include "engine/view/patch_kernel_body.h"

namespace acentric {
namespace {

struct PatchLanes : EightLanes {
  static I shiftRightBy(I a, I bits) { return {_mm256_srlv_epi32(a.v, bits.v)}; }
  static I shiftLeftBy(I a, int bits) { return {_mm256_sll_epi32(a.v, _mm_cvtsi32_si128(bits))}; }
  static __m256i firstPairs(int count) {
    return _mm256_cmpgt_epi64(_mm256_set1_epi64x(count), _mm256_setr_epi64x(0, 1, 2, 3));
  }
  static void loadPairs(const std::uint64_t* p, int count, I& low, I& high) {
    const auto* from = reinterpret_cast<const long long*>(p);
    const __m256 first = _mm256_castsi256_ps(_mm256_maskload_epi64(from, firstPairs(count)));
    const __m256 second = _mm256_castsi256_ps(_mm256_maskload_epi64(from + 4, firstPairs(count - 4)));
    const auto inOrder = [](__m256 mixed) {
      return I{_mm256_permute4x64_epi64(_mm256_castps_si256(mixed), 0xd8)};
    };
    low = inOrder(_mm256_shuffle_ps(first, second, 0x88));
    high = inOrder(_mm256_shuffle_ps(first, second, 0xdd));
  }
  static void storePairs(std::uint64_t* p, I low, I high, int count) {
    auto* to = reinterpret_cast<long long*>(p);
    const __m256i even = _mm256_unpacklo_epi32(low.v, high.v), odd = _mm256_unpackhi_epi32(low.v, high.v);
    _mm256_maskstore_epi64(to, firstPairs(count), _mm256_permute2x128_si256(even, odd, 0x20));
    _mm256_maskstore_epi64(to + 4, firstPairs(count - 4), _mm256_permute2x128_si256(even, odd, 0x31));
  }
};

}  // namespace

const PatchKernel kPatchKernelAvx2 = patch_kernel::kVariant<PatchLanes>;

}  // namespace acentric
#endif
