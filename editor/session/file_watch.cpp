#include "editor/session/file_watch.h"

#include <utility>

namespace acentric::editor {
namespace fs = std::filesystem;

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
