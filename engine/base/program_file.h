#pragma once
/// Parts of the program that are files of their own.

#include <filesystem>
#include <string_view>

namespace acentric {

/// The file of the program that runs; empty where that is not known.
std::filesystem::path ownProgram();

/// Where this part is: in ../libexec/acentric of an installed program's folder, else beside the program, as
/// where it was built. It need not exist.
std::filesystem::path programFile(std::string_view name);

}  // namespace acentric
