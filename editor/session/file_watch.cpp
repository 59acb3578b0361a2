#include "editor/session/file_watch.h"

#include <utility>

namespace acentric::editor {
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

FileWatch::FileWatch(std::vector<FileStamp> asRead) : asRead_(std::move(asRead)) {
  for (const FileStamp& stamp : asRead_) last_.push_back(stamp.look);
  told_ = last_;
}

std::vector<FileLook> FileWatch::looks() const {
  std::vector<FileLook> looks;
  looks.reserve(asRead_.size());
  for (const FileStamp& stamp : asRead_) looks.push_back(lookAt(stamp.file));
  return looks;
}

bool FileWatch::look() {
  std::vector<FileLook> now = looks();
  const bool still = now == last_;
  last_ = std::move(now);
  if (!still || last_ == told_) return false;
  told_ = last_;
  return true;
}

std::vector<fs::path> FileWatch::different() const {
  std::vector<fs::path> files;
  for (const FileStamp& stamp : asRead_)
    if (differs(stamp)) files.push_back(stamp.file);
  return files;
}

}  // namespace acentric::editor
