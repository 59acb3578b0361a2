#pragma once
/// Reads walks (FORMAT.md, "Walks") by ranges, as the files of the bundle that they were made from.

#include <filesystem>
#include <memory>
#include <span>

#include "engine/export/bundle_read.h"

namespace acentric {

/// One file, of which parts are read. May be asked from several threads at once, if its user does so.
class ByteRanges {
 public:
  virtual ~ByteRanges() = default;
  virtual Result<std::uint64_t> size() const = 0;
  /// All of `into`, from `at` on: within the size.
  virtual Status read(std::uint64_t at, std::span<std::byte> into) const = 0;
};

Result<std::unique_ptr<ByteRanges>> fileRanges(const std::filesystem::path& file);

/// All pages of the index are read at once. `name`: of the walk, for messages.
Result<std::unique_ptr<BundleFiles>> walkFiles(std::unique_ptr<ByteRanges> ranges, const std::string& name);

/// The folder of a bundle, or a walk?
bool isBundle(const std::filesystem::path& path);
/// Opened as what it is.
Result<std::unique_ptr<BundleFiles>> bundleAt(const std::filesystem::path& path);

}  // namespace acentric
