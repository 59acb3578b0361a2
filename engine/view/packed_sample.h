#pragma once
/// A sample as kernels read it: all that projecting it takes, side by side in eight bytes, because samples
/// are read in short runs here and there and each place in memory that a run begins at must be waited for.
/// Free of the standard library and of functions, for the kernels; walk_scene.h has those.

#include <cstdint>

namespace acentric {

struct PackedSample {
  /// 1/m, horizontal: the bits of a float but for its last eight, which captures do not use
  /// (storedInverseDistance). Instead of those: the roles that need the sample.
  std::uint32_t inverseDistanceAndRoles;
  std::uint32_t row;
  bool operator==(const PackedSample&) const = default;
};
static_assert(sizeof(PackedSample) == 8);

}  // namespace acentric
