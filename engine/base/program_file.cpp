#include "engine/base/program_file.h"

namespace acentric {
namespace fs = std::filesystem;

fs::path ownProgram() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error);
}

fs::path programFile(std::string_view name) {
  std::error_code error;
  const fs::path folder = ownProgram().parent_path();
  const fs::path installed = (folder / "../libexec/acentric" / name).lexically_normal();
  return fs::exists(installed, error) ? installed : folder / name;
}

}  // namespace acentric
