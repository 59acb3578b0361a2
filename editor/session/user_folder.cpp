#include "editor/session/user_folder.h"

#include <cstdlib>

namespace acentric::editor {
namespace fs = std::filesystem;

fs::path userFolder(const char* variable, const char* inHome) {
  const char* named = std::getenv(variable);
  if (named != nullptr && *named == '/') return fs::path(named) / "acentric";
  const char* home = std::getenv("HOME");
  if (home != nullptr && *home != '\0') return fs::path(home) / inHome / "acentric";
  return {};
}

}  // namespace acentric::editor
