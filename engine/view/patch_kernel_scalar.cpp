#include "engine/view/lanes_scalar.h"
#include "engine/view/patch_kernel_body.h"

namespace acentric {
namespace {

struct PatchLanes : OneLane {
  static std::int32_t lowest(I a) { return a; }
  static I shiftRightBy(I a, I bits) { return static_cast<I>(static_cast<std::uint32_t>(a) >> bits); }
  static I shiftLeftBy(I a, int bits) { return a << bits; }
  static void gatherNext(const std::uint32_t* table, I index, I& at, I& next) {
    at = gather(table, index), next = gather(table, index + 1);
  }
  static F inHalves(float first, float) { return set(first); }
};

}  // namespace

const PatchKernel kPatchKernelScalar = patch_kernel::kVariant<PatchLanes>;

}  // namespace acentric
