#include "engine/view/lanes_scalar.h"
#include "engine/view/patch_kernel_body.h"

namespace acentric {
namespace {

struct PatchLanes : OneLane {
  static I shiftRightBy(I a, I bits) { return static_cast<I>(static_cast<std::uint32_t>(a) >> bits); }
  static I shiftLeftBy(I a, int bits) { return static_cast<I>(static_cast<std::uint32_t>(a) << bits); }
  static void loadPairs(const std::uint64_t* p, int, I& low, I& high) {
    low = static_cast<I>(static_cast<std::uint32_t>(*p)), high = static_cast<I>(*p >> 32);
  }
  static void storePairs(std::uint64_t* p, I low, I high, int) {
    *p = static_cast<std::uint32_t>(low) | std::uint64_t(static_cast<std::uint32_t>(high)) << 32;
  }
};

}  // namespace

const PatchKernel kPatchKernelScalar = patch_kernel::kVariant<PatchLanes>;

}  // namespace acentric
