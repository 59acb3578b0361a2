#include "engine/view/warp_kernel_body.h"
#include "engine/view/warp_lane.h"

namespace acentric {
int projectSamplesScalar(const ProjectColumn& column, const SampleColumn& samples, const SampleRun* runs,
                         int runCount, const SplatArrays& out) {
  return warp_kernel::projectColumn<WarpLane>(column, samples, runs, runCount, out);
}

int findBlocksScalar(const ProjectColumn& column, const BlockTest& test, const BlockColumn& blocks, int count,
                     std::uint16_t* out) {
  return warp_kernel::findBlocks<WarpLane>(column, test, blocks, count, out);
}

}  // namespace acentric
