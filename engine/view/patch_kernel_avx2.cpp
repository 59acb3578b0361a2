#if defined(__x86_64__)
#include "engine/view/lanes_avx2.h"
#include "engine/view/patch_kernel_body.h"

namespace acentric {
namespace {

struct PatchLanes : EightLanes {
  static I shiftRightBy(I a, I bits) { return {_mm256_srlv_epi32(a.v, bits.v)}; }
  static I shiftLeftBy(I a, int bits) { return {_mm256_sll_epi32(a.v, _mm_cvtsi32_si128(bits))}; }
};

}  // namespace

const PatchKernel kPatchKernelAvx2 = patch_kernel::kVariant<PatchLanes>;

}  // namespace acentric
#endif
