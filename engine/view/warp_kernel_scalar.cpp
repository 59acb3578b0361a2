#include "engine/view/warp_kernel_body.h"
#include "engine/view/warp_lane.h"

namespace acentric {
int projectSamplesScalar(const ProjectColumn& column, const SampleColumn& samples, std::uint32_t count,
                         const SplatArrays& out) {
  return warp_kernel::projectColumn<WarpLane>(column, samples, count, out);
}

}  // namespace acentric
