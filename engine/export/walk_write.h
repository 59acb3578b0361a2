#pragma once
/// A bundle as one file.

#include <filesystem>
#include <stop_token>

#include "engine/base/result.h"

namespace acentric {

struct WalkOptions {
  int regionsPerPage = 64;  ///< of the index
};

/// From the folder of a bundle. What the walk begins with comes first, then region after region outwards. The
/// same bundle gives the same bytes; `file` is replaced as a whole. Returns its size.
Result<std::uint64_t> writeWalk(const std::filesystem::path& bundle, const std::filesystem::path& file,
                                const WalkOptions& options = {}, const std::stop_token& stop = {});

}  // namespace acentric
