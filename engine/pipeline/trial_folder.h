#pragma once
/// A folder for files that are only made to see what they cost.

#include <filesystem>
#include <utility>

#include "engine/base/result.h"

namespace acentric {

/// Goes with its owner.
class TrialFolder {
 public:
  /// In `preferred`, where the real files would go, else where temporary files go.
  static Result<TrialFolder> make(const std::filesystem::path& preferred);
  TrialFolder(TrialFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  TrialFolder& operator=(TrialFolder&&) = delete;
  ~TrialFolder();
  const std::filesystem::path& path() const { return path_; }

 private:
  explicit TrialFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
};

}  // namespace acentric
