#pragma once
/// Have the files of a model been changed since they were read?

#include <filesystem>
#include <vector>

#include "engine/base/file_stamp.h"

namespace acentric::editor {

/// Several files. look() belongs to one thread; different() may be asked of a copy on another.
class FileWatch {
 public:
  explicit FileWatch(std::vector<FileStamp> asRead);

  /// Sizes and times only. True once for each new state of the files, as soon as they have kept still
  /// between two looks: who writes them has probably finished.
  bool look();
  /// Those whose content is not what was read, or that came or went.
  std::vector<std::filesystem::path> different() const;

 private:
  std::vector<FileLook> looks() const;

  std::vector<FileStamp> asRead_;
  std::vector<FileLook> last_;  ///< at the look before
  std::vector<FileLook> told_;  ///< the state that was told last
};

/// The model and the files that it names.
struct SceneFiles {
  enum class State { asImported, changed, missing };
  State state = State::asImported;
  std::vector<std::filesystem::path> changed;  ///< of `changed`: which
  bool fromCache = false;  ///< of `missing`: what is shown is the last import; else nothing of it is there
  bool operator==(const SceneFiles&) const = default;
};

}  // namespace acentric::editor
