#pragma once
/// The order in which the patches of a strip are drawn, from which of them may hide which.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace acentric {

/// Two patches, by number: the one that goes first, since it may hide the other.
struct PatchPair {
  std::uint32_t first = 0, second = 0;
  int weight = 1;  ///< how much is lost if they are drawn the other way round
};

struct PatchOrder {
  std::vector<std::uint32_t> patches;
  std::size_t broken = 0;  ///< pairs that are drawn the other way round
};

/// Breaks only pairs within rings of patches that hide each other; there, what is hidden least for what it
/// hides goes first (Eades, Lin and Smyth 1993), or if `nearestFirst` what is nearest. All others in the
/// order of the pairs, nearest first. `nearest`: of each patch, its largest inverse distance.
PatchOrder orderPatches(const std::vector<PatchPair>& pairs, const std::vector<float>& nearest,
                        bool nearestFirst);

}  // namespace acentric
