#pragma once
/// One file under two names.

#include <filesystem>

#include "engine/base/result.h"

namespace acentric {

/// A hard link where the disk can make one, else a copy that takes the place of `to` at once, whole.
Status linkOrCopyFile(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace acentric
