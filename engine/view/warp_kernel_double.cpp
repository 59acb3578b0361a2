#include "engine/view/warp_kernel_body.h"
#include "engine/view/warp_lane.h"

namespace acentric {
namespace {

/// One lane whose floats are doubles.
struct DoubleLane : WarpLane {
  using F = double;
  static F set(double value) { return value; }
  static F select(M m, F a, F b) { return m ? a : b; }
  static I select(M m, I a, I b) { return m ? a : b; }
  static F abs(F a) { return __builtin_fabs(a); }
  static F sqrt(F a) { return __builtin_sqrt(a); }
  static F min(F a, F b) { return a < b ? a : b; }
  static F max(F a, F b) { return a > b ? a : b; }
  static F asFloat(I bits) { return OneLane::asFloat(bits); }
  static I asInts(F value) { return OneLane::asInts(static_cast<float>(value)); }
  static F toFloat(I a) { return a; }
  static I floor(F a) { return static_cast<I>(__builtin_floor(a)); }
  static I ceil(F a) { return static_cast<I>(__builtin_ceil(a)); }
  static F tangents(const double* table, const PackedSample* rising, I) { return table[rising->row]; }
};

}  // namespace

int projectSamplesDouble(const ProjectColumnOf<double>& column, const SampleColumnOf<double>& samples,
                         std::uint32_t count, const SplatArrays& out) {
  return warp_kernel::projectColumn<DoubleLane>(column, samples, count, out);
}

}  // namespace acentric
