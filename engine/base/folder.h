#pragma once
/// Folders as wholes: one is written beside its place and put there at once.

#include <filesystem>
#include <functional>

#include "engine/base/result.h"

namespace acentric {

/// `write(temporary)` fills a new folder beside `path`; then it is flushed to disk and takes the place of
/// `path`, which may exist. On failure the temporary is removed, and `path` stays as it was. What killed
/// processes left beside it is removed.
Status replaceFolderAtomically(const std::filesystem::path& path,
                               const std::function<Status(const std::filesystem::path& temporary)>& write);

}  // namespace acentric
