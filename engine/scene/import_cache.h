#pragma once
/// Where imports are kept.

#include <filesystem>
#include <optional>
#include <string>

#include "engine/scene/import.h"

namespace acentric {

/// The host's folder, else the user's; where that cannot be written (no home, as in containers), one in the
/// folder for temporary files that is nobody else's.
std::filesystem::path importCacheFolder(const ImportHost& host);

/// What to tell the user where it is not the usual one.
std::optional<std::string> importCacheNotice(const ImportHost& host);

}  // namespace acentric
