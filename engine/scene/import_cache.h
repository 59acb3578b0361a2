#pragma once
/// Where imports are kept.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "engine/scene/import.h"

namespace acentric {

/// A folder of this name in the user's cache; where that cannot be written (no home, as in containers), in
/// one in the folder for temporary files that is nobody else's.
std::filesystem::path keptFolder(std::string_view name);

/// The host's folder, else the kept one for scenes.
std::filesystem::path importCacheFolder(const ImportHost& host);

/// What to tell the user where it is not the usual one.
std::optional<std::string> importCacheNotice(const ImportHost& host);

}  // namespace acentric
