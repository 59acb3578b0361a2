#pragma once
/// A file's bytes as memory, read by the system page by page when they are looked at, and given back by it
/// when memory is short; processes that map one file share its pages.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>

#include "engine/base/result.h"

namespace acentric {

/// Files that are mapped are to be replaced or removed, which leaves the bytes seen here as they are, never
/// cut short or written to.
class MappedFile {
 public:
  /// Of a regular file; an empty one has no bytes.
  static Result<std::shared_ptr<const MappedFile>> open(const std::filesystem::path& path);
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();

  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  explicit MappedFile(std::span<const std::byte> bytes) : bytes_(bytes) {}
  std::span<const std::byte> bytes_;
};

}  // namespace acentric
