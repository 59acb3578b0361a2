#pragma once
/// A share of a bake, for a bake larger than one machine: any number of processes, on any machines, bake one
/// project into one store. A share follows from the project alone, so shares need not know of each other; the
/// store takes writers side by side, and whatever is baked twice is the same twice.

#include <cstddef>
#include <string_view>

#include "engine/base/result.h"

namespace acentric {

struct Shard {
  int number = 1;  ///< 1..count
  int count = 1;

  /// What is to be baked is numbered: the cameras of all storeys in order, then the storeys' surface light.
  /// Every count-th of it is this shard's: neighbouring cameras cost about as much, so shares are even.
  bool takes(std::size_t item) const { return item % std::size_t(count) == std::size_t(number - 1); }
  bool whole() const { return count == 1; }
};

inline constexpr int kMostShards = 100'000;

/// "2/8".
Result<Shard> parseShard(std::string_view text);

}  // namespace acentric
