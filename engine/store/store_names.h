#pragma once
/// How the store's files are called. Private to this folder.

#include <filesystem>
#include <string>
#include <string_view>

#include "engine/base/hash.h"
#include "engine/base/result.h"

namespace acentric {

inline constexpr const char* kPackExtension = ".pack";
inline constexpr const char* kDamagedExtension = ".damaged";
inline constexpr const char* kRecordExtension = ".record";
inline constexpr const char* kLightExtension = ".light";
inline constexpr std::string_view kLightPrefix = "surface-";
inline constexpr const char* kLightPartExtension = ".part";
inline constexpr const char* kSimplifiedExtension = ".local";
inline constexpr std::string_view kSimplifiedPrefix = "simplified-";

inline std::filesystem::path packOf(const std::filesystem::path& folder, const ContentKey& key) {
  return folder / (key.toHex() + kPackExtension);
}
inline std::filesystem::path recordOf(const std::filesystem::path& folder, const ContentKey& key) {
  return folder / (key.toHex() + kRecordExtension);
}
inline std::filesystem::path lightOf(const std::filesystem::path& folder, const ContentKey& key) {
  return folder / (std::string(kLightPrefix) + key.toHex() + kLightExtension);
}
/// `runs`: which of them are in it, as lightPartName() says.
inline std::filesystem::path lightPartOf(const std::filesystem::path& folder, const ContentKey& key,
                                         const std::string& runs) {
  return folder / (std::string(kLightPrefix) + key.toHex() + "." + runs + kLightPartExtension);
}
inline std::filesystem::path simplifiedOf(const std::filesystem::path& folder, const ContentKey& key) {
  return folder / (std::string(kSimplifiedPrefix) + key.toHex() + kSimplifiedExtension);
}

inline bool isFile(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

/// 0 where there is none.
inline std::uint64_t sizeOf(const std::filesystem::path& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  return error ? 0 : size;
}

/// Only contents that are wrong count as damage: a disk or memory in trouble says nothing about the file.
inline bool isDamage(const Error& error) {
  return error.kind == ErrorKind::malformed || error.kind == ErrorKind::unsupported;
}

}  // namespace acentric
