#include "engine/pipeline/shard.h"

#include <fmt/format.h>

#include <charconv>

namespace acentric {

Result<Shard> parseShard(std::string_view text) {
  Shard shard;
  const char* end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, shard.number);
  if (number.ec == std::errc{} && number.ptr != end && *number.ptr == '/') {
    const auto count = std::from_chars(number.ptr + 1, end, shard.count);
    if (count.ec == std::errc{} && count.ptr == end && shard.number >= 1 && shard.number <= shard.count &&
        shard.count <= kMostShards)
      return shard;
  }
  return fail(ErrorKind::invalidArgument,
              fmt::format("'{}' is no share of a bake: say which of how many, such as 2/8 (1/8 to 8/8; at "
                          "most {})",
                          text, kMostShards));
}

}  // namespace acentric
