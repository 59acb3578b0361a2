#include "engine/base/file_stamp.h"

namespace acentric {
namespace fs = std::filesystem;

FileLook lookAt(const fs::path& file) {
  std::error_code error;
  FileLook look;
  look.size = fs::file_size(file, error);
  if (error) return {};
  look.modified = fs::last_write_time(file, error);
  look.exists = !error;
  return look.exists ? look : FileLook{};
}

FileStamp stampOf(const fs::path& file) {
  FileStamp stamp{file, lookAt(file), {}};
  if (stamp.look.exists)
    if (const auto content = hashFile(file)) stamp.content = *content;
  return stamp;
}

bool differs(const FileStamp& was) {
  const FileLook now = lookAt(was.file);
  if (now == was.look) return false;
  return now.exists != was.look.exists || stampOf(was.file).content != was.content;
}

}  // namespace acentric
