#include "engine/base/link_file.h"

#include "engine/base/file.h"

namespace acentric {
namespace fs = std::filesystem;

Status linkOrCopyFile(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::create_hard_link(from, to, error);
  if (!error) return {};
  return replaceFileAtomically(to, [&](const fs::path& temporary) -> Status {
    std::error_code failed;
    fs::copy_file(from, temporary, fs::copy_options::overwrite_existing, failed);
    if (failed)
      return fail(ErrorKind::unreadable, "cannot be copied to " + to.string() + ": " + failed.message(),
                  from.string());
    return {};
  });
}

}  // namespace acentric
