#pragma once
/// The files that a model file names (buffers, textures, material libraries): where they are, whether they
/// may be read, and which were read, so that a cached import knows when it is out of date. Private to this
/// folder.
///
/// A file is read only from the model's own folder or below it, all links resolved: a model from elsewhere
/// must not bring other files of this machine into what is published. A model that was brought to
/// models/NAME beside a project file may lie deeper there, with its files beside its folder: then models/NAME
/// is the limit. Who means it may allow more. Back slashes, a missing drive and wrong letter case are
/// forgiven.

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/hash.h"
#include "engine/base/result.h"

namespace acentric {

/// The folder within which a model may name files; `model` is canonical.
std::filesystem::path readableFolderOf(const std::filesystem::path& model);

struct Dependency {
  std::string path;  ///< relative to the model's folder, or absolute
  bool exists = false;
  std::uint64_t size = 0;
  std::int64_t modifiedNanoseconds = 0;
  std::uint64_t inode = 0;
  ContentKey content;
};

class References {
 public:
  explicit References(const std::filesystem::path& model, bool allowOutside = false);

  const std::filesystem::path& folder() const { return folder_; }

  /// The file that `named` means. A file that does not exist is remembered too: it may appear later.
  Result<std::filesystem::path> find(std::string_view named);
  /// The bytes of the file that `named` means.
  Result<std::vector<std::byte>> read(std::string_view named, std::size_t maxBytes);
  /// A library opened this file itself.
  void noteRead(const std::filesystem::path& path);
  bool mayRead(const std::filesystem::path& path) const;
  /// What to say of a file that may not be read.
  static Error outside(const std::filesystem::path& path, std::string named);

  /// Everything asked for, with sizes, times and contents as they are now.
  Result<std::vector<Dependency>> dependencies() const;

 private:
  std::string keyFor(const std::filesystem::path& path) const;

  std::filesystem::path folder_;  ///< canonical, the model's own
  std::filesystem::path within_;  ///< canonical: files are read from here
  std::filesystem::path model_;
  bool allowOutside_;
  std::map<std::string, bool> files_;  ///< path as in Dependency -> existed
};

/// Is the file as it was? Reads its content only where size, time or inode differ.
bool unchanged(const Dependency& dependency, const std::filesystem::path& modelFolder);

}  // namespace acentric
