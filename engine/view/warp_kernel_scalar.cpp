#include "engine/view/lanes_scalar.h"
#include "engine/view/warp_kernel_body.h"

namespace acentric {
namespace {

struct WarpLane : OneLane {
  using OneLane::load;
  static void load(const PackedSample* p, I& inverseAndRoles, I& rowAndSlant) {
    inverseAndRoles = static_cast<I>(p->inverseDistanceAndRoles);
    rowAndSlant = p->row | static_cast<std::uint8_t>(p->slant.across) << 16 |
                  static_cast<I>(static_cast<std::uint32_t>(p->slant.down) << 24);
  }
  static F tangents(const float* table, const PackedSample* rising, I) { return table[rising->row]; }
  /// Of blocks, and of samples.
  static M needed(const std::uint8_t* roles, std::uint32_t wanted) { return (*roles & wanted) != 0; }
  static M needed(I roles, std::uint32_t wanted) { return (static_cast<std::uint32_t>(roles) & wanted) != 0; }
  struct Size {
    std::uint8_t width, height, placeX, placeY;
  };
  static Size pack(I width, I height, I placeX, I placeY) {
    return {static_cast<std::uint8_t>(width), static_cast<std::uint8_t>(height),
            static_cast<std::uint8_t>(placeX), static_cast<std::uint8_t>(placeY)};
  }
  static int append(M accepted, I x, I y, Size size, std::uint32_t index, I spread, F inverseZDepth,
                    Splat* out) {
    if (!accepted) return 0;
    *out = {static_cast<std::int16_t>(x),
            static_cast<std::int16_t>(y),
            size.width,
            size.height,
            size.placeX,
            size.placeY,
            index & 0xfffffffu,
            static_cast<std::uint32_t>(spread) & 7u,
            static_cast<std::uint32_t>(spread) >> 3 & 1u,
            inverseZDepth};
    return 1;
  }
};

}  // namespace

int projectSamplesScalar(const ProjectColumn& column, const SampleColumn& samples, const SampleRun* runs,
                         int runCount, Splat* out) {
  return warp_kernel::projectColumn<WarpLane>(column, samples, runs, runCount, out);
}

int findBlocksScalar(const ProjectColumn& column, const BlockTest& test, const BlockColumn& blocks, int count,
                     std::uint16_t* out) {
  return warp_kernel::findBlocks<WarpLane>(column, test, blocks, count, out);
}

}  // namespace acentric
