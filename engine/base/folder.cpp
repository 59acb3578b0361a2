#include "engine/base/folder.h"

#include <fcntl.h>
#include <stdio.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "engine/base/file.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;

/// The names in it, that is; files that are written atomically have flushed themselves.
void flushFolder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  (void)::fsync(descriptor);
  ::close(descriptor);
}

Status putInPlace(const fs::path& temporary, const fs::path& path) {
  if (::rename(temporary.c_str(), path.c_str()) == 0) return {};  // nothing is there, or an empty folder
  if (::renameat2(AT_FDCWD, temporary.c_str(), AT_FDCWD, path.c_str(), RENAME_EXCHANGE) == 0) return {};
  // A file system that cannot exchange two names.
  fs::path aside = temporary;
  aside += ".old";
  std::error_code error;
  if (::rename(path.c_str(), aside.c_str()) == 0 && ::rename(temporary.c_str(), path.c_str()) == 0) {
    fs::remove_all(aside, error);
    return {};
  }
  const std::string reason = std::strerror(errno);
  fs::rename(aside, path, error);
  return fail(ErrorKind::unreadable, "cannot be put in place: " + reason, path.string());
}

}  // namespace

Status replaceFolderAtomically(const fs::path& path, const std::function<Status(const fs::path&)>& write) {
  std::error_code error;
  const fs::path target = fs::absolute(path, error).lexically_normal();
  const fs::path whole = target.has_filename() ? target : target.parent_path();
  const fs::path parent = whole.parent_path();
  fs::create_directories(parent, error);
  if (error) return fail(ErrorKind::unreadable, "folder cannot be made: " + error.message(), parent.string());
  removeStaleTemporaries(parent);
  const fs::path temporary = parent / (temporaryNameStart() + whole.filename().string());
  const auto attempt = [&]() -> Status {
    fs::create_directory(temporary, error);
    if (error)
      return fail(ErrorKind::unreadable, "folder cannot be made: " + error.message(), temporary.string());
    if (Status written = write(temporary); !written) return written;
    flushFolder(temporary);
    if (Status placed = putInPlace(temporary, whole); !placed) return placed;
    flushFolder(parent);
    return {};
  };
  const Status result = attempt();
  fs::remove_all(temporary, error);
  return result;
}

}  // namespace acentric
