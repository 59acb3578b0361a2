#include "engine/view/kernels.h"

#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace acentric {
namespace {

constexpr Kernels kKernels[] = {
    {"scalar", shadeRunScalar, coverRowScalar, blendRowScalar, &kPatchKernelScalar},
#if defined(__x86_64__)
    {"AVX2", shadeRunAvx2, coverRowAvx2, blendRowAvx2, &kPatchKernelAvx2},
    {"AVX-512", shadeRunAvx512, coverRowAvx512, blendRowAvx512, &kPatchKernelAvx512},
#endif
};

#if defined(__x86_64__)
/// Clang's __builtin_cpu_supports does not know it.
bool hasF16c() {
  unsigned a = 0, b = 0, c = 0, d = 0;
  return __get_cpuid(1, &a, &b, &c, &d) != 0 && (c & bit_F16C) != 0;
}
#endif

std::size_t supported() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    return 3;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2") && hasF16c()) return 2;
#endif
  return 1;
}

}  // namespace

std::span<const Kernels> supportedKernels() { return {kKernels, supported()}; }

}  // namespace acentric
