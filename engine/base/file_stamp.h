#pragma once
/// Has a file that others may write been changed since it was read? Told by size and time first, which is
/// cheap; only where those differ the content decides.

#include <filesystem>

#include "engine/base/hash.h"

namespace acentric {

/// Size and time of a file.
struct FileLook {
  bool exists = false;
  std::uintmax_t size = 0;
  std::filesystem::file_time_type modified{};
  bool operator==(const FileLook&) const = default;
};
FileLook lookAt(const std::filesystem::path& file);

/// A file as it was read.
struct FileStamp {
  std::filesystem::path file;
  FileLook look;
  ContentKey content;  ///< zero where it does not exist or cannot be read
};
/// Reads it.
FileStamp stampOf(const std::filesystem::path& file);
/// Reads the content only where size or time differ.
bool differs(const FileStamp& was);

}  // namespace acentric
