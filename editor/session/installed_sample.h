#pragma once
/// The sample project that is installed with the program. Each user gets a copy of it: what is baked lies
/// beside a project, and nobody writes where programs are installed.

#include <filesystem>

#include "engine/base/result.h"

namespace acentric::editor {

/// The folder share/acentric/sample beside that of `program`; empty where none is installed.
std::filesystem::path installedSample(const std::filesystem::path& program);

/// $XDG_DATA_HOME/acentric, else ~/.local/share/acentric; empty without a home.
std::filesystem::path userDataFolder();

/// The project file of the copy in `folder`/gallery, which is made unless it is there.
Result<std::filesystem::path> copyOfSample(const std::filesystem::path& installed,
                                           const std::filesystem::path& folder);

}  // namespace acentric::editor
