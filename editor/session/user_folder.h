#pragma once
/// Where the editor keeps what is a user's own.

#include <filesystem>

namespace acentric::editor {

/// Acentric's folder below the one that an environment variable of the XDG Base Directory Specification
/// names, else below `inHome` of the user's home; empty without a home.
std::filesystem::path userFolder(const char* variable, const char* inHome);

}  // namespace acentric::editor
