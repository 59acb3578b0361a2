#include "engine/view/lanes_scalar.h"
#include "engine/view/patch_kernel_body.h"

namespace acentric {
namespace {

struct PatchLanes : OneLane {
  static I shiftRightBy(I a, I bits) { return static_cast<I>(static_cast<std::uint32_t>(a) >> bits); }
  static I shiftLeftBy(I a, int bits) { return static_cast<I>(static_cast<std::uint32_t>(a) << bits); }
};

}  // namespace

const PatchKernel kPatchKernelScalar = patch_kernel::kVariant<PatchLanes>;

}  // namespace acentric
