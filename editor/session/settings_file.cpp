#include "editor/session/settings_file.h"

#include "engine/base/file.h"
#include "engine/base/json_text.h"

namespace acentric::editor {

Status saveSettings(const nlohmann::json& settings, const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  if (error)
    return fail(ErrorKind::unreadable, "the folder cannot be made: " + error.message(),
                file.parent_path().string());
  return writeTextAtomically(file, jsonText(settings, 2) + "\n");
}

}  // namespace acentric::editor
