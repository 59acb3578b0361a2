#pragma once
/// Folders that exports are written to: new ones, empty ones, or such that hold an earlier export.

#include <filesystem>
#include <string>

#include "engine/base/result.h"

namespace acentric {

/// May an export be put there whose file `index` names `format` near its beginning? `what` is the word for
/// it: "bundle".
Status checkExportTarget(const std::filesystem::path& folder, const std::string& index,
                         const std::string& format, const std::string& what);

}  // namespace acentric
