#pragma once
/// Packs that are damaged on purpose.

#include <cstring>
#include <vector>

#include "engine/base/hash.h"

namespace acentric::test {

/// Gives changed bytes of a pack the size and the checksum that they need to be believed.
inline void seal(std::vector<std::byte>& pack) {
  const std::size_t checked = pack.size() - 16;
  const std::uint64_t fileBytes = pack.size();
  std::memcpy(pack.data() + 32, &fileBytes, sizeof fileBytes);
  const ContentKey checksum = Hasher().bytes(pack.data(), checked).finish();
  std::memcpy(pack.data() + checked, &checksum.high, 8);
  std::memcpy(pack.data() + checked + 8, &checksum.low, 8);
}

}  // namespace acentric::test
