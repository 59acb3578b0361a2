#include "editor/session/installed_sample.h"

#include <fmt/format.h>
#include <unistd.h>

#include "editor/session/user_folder.h"

namespace acentric::editor {
namespace {
namespace fs = std::filesystem;
constexpr const char* kProject = "gallery.acentric.json";
}  // namespace

fs::path installedSample(const fs::path& program) {
  const fs::path folder = (program.parent_path() / "../share/acentric/sample").lexically_normal();
  std::error_code error;
  return fs::is_regular_file(folder / kProject, error) ? folder : fs::path();
}

fs::path userDataFolder() { return userFolder("XDG_DATA_HOME", ".local/share"); }

Result<fs::path> copyOfSample(const fs::path& installed, const fs::path& folder) {
  const fs::path sample = folder / "gallery";
  std::error_code error;
  if (fs::is_regular_file(sample / kProject, error)) return sample / kProject;
  // Complete or not there: it gets its name last.
  const fs::path copy = folder / fmt::format("gallery.{}", ::getpid());
  fs::create_directories(folder, error);
  if (!error) fs::copy(installed, copy, fs::copy_options::recursive, error);
  if (!error) fs::rename(copy, sample, error);
  if (error) {
    std::error_code ignored;
    fs::remove_all(copy, ignored);
    return fail(ErrorKind::unreadable, "the sample cannot be copied here: " + error.message(),
                sample.string());
  }
  return sample / kProject;
}

}  // namespace acentric::editor
