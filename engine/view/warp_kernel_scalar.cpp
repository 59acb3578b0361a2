#include "engine/view/warp_kernel_body.h"

namespace acentric {
namespace {

/// One sample at a time, on any processor. min and max choose as the processor's vector instructions do
/// (the second operand where either is not a number).
struct OneLane {
  static constexpr int kWidth = 1;
  using F = float;
  using I = std::int32_t;
  using M = bool;
  static F set(float value) { return value; }
  static I seti(std::int32_t value) { return value; }
  static F load(const float* p) { return *p; }
  static F gather(const float* table, const std::uint16_t* rising) { return table[*rising]; }
  static M needed(const std::uint8_t* roles, std::uint32_t wanted) { return (*roles & wanted) != 0; }
  static M less(F a, F b) { return a < b; }
  static M notLess(F a, F b) { return a >= b; }
  static M greater(I a, I b) { return a > b; }
  static bool any(M m) { return m; }
  static unsigned bits(M m) { return m; }
  static M either(M a, M unlessB) { return a || !unlessB; }
  static F abs(F a) { return __builtin_fabsf(a); }
  static F sqrt(F a) { return __builtin_sqrtf(a); }
  static F min(F a, F b) { return a < b ? a : b; }
  static F max(F a, F b) { return a > b ? a : b; }
  static F select(M m, F a, F b) { return m ? a : b; }
  static F toFloat(I a) { return static_cast<float>(a); }
  static I floor(F a) {
    const I whole = static_cast<I>(a);
    return whole - (static_cast<float>(whole) > a);
  }
  static I ceil(F a) {
    const I whole = static_cast<I>(a);
    return whole + (static_cast<float>(whole) < a);
  }
  static I gather(const std::uint32_t* table, I index) { return static_cast<I>(table[index]); }
  static I when(M m, I a) { return m ? a : 0; }
  static I times(I a, I b) { return a * b; }
  static I mini(I a, I b) { return a < b ? a : b; }
  static I maxi(I a, I b) { return a > b ? a : b; }
  /// Tangents of the slants along row and column.
  static void slants(const Slant* p, F& across, F& down) {
    const auto tangent = [](std::int8_t code) {
      const F size = static_cast<F>(code);
      return size / (127.0f - abs(size));
    };
    across = tangent(p->across), down = tangent(p->down);
  }
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
  return warp_kernel::projectColumn<OneLane>(column, samples, runs, runCount, out);
}

int findBlocksScalar(const ProjectColumn& column, const BlockTest& test, const BlockColumn& blocks, int count,
                     std::uint16_t* out) {
  return warp_kernel::findBlocks<OneLane>(column, test, blocks, count, out);
}

}  // namespace acentric
