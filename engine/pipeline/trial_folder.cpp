#include "engine/pipeline/trial_folder.h"

#include <cstdlib>
#include <string>

#include "engine/base/file.h"

namespace acentric {
namespace fs = std::filesystem;

Result<TrialFolder> TrialFolder::make(const fs::path& preferred) {
  std::error_code error;
  for (const fs::path& parent : {preferred, fs::temp_directory_path(error)}) {
    std::string name = (parent / (temporaryNameStart() + "trial-XXXXXX")).string();
    if (::mkdtemp(name.data()) != nullptr) return TrialFolder(name);
  }
  return fail(ErrorKind::unreadable, "no folder for trial files can be made here, nor a temporary one",
              preferred.string());
}

TrialFolder::~TrialFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

}  // namespace acentric
