#pragma once
/// Walks: bundles as one file, made to be read by ranges (FORMAT.md, "Walks"). What its writer and its
/// readers share.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace acentric::walk_format {

inline constexpr std::array<char, 8> kMagic{'A', 'C', 'W', 'A', 'L', 'K', '\r', '\n'};
inline constexpr std::uint32_t kVersion = 1;
inline constexpr std::size_t kHeaderBytes = 88;
/// Unpacked, of the root and of one page.
inline constexpr std::uint64_t kMostRootBytes = std::uint64_t(64) << 20, kMostPageBytes = std::uint64_t(16)
                                                                                          << 20;

/// Little-endian, as it is in memory.
struct Header {
  std::uint64_t fileBytes = 0;
  std::uint64_t rootBytes = 0, rootRaw = 0;  ///< packed and unpacked; right behind the header
  std::uint64_t pageStart = 0, dataStart = 0;
  std::array<std::uint64_t, 2> rootHash{};  ///< XXH3-128, high half first
};

using HeaderBytes = std::array<std::byte, kHeaderBytes>;
HeaderBytes headerBytes(const Header& header);
Result<Header> headerOf(std::span<const std::byte> bytes, const std::string& name);

std::string hashText(std::span<const std::byte> bytes);
/// Fails where it is not what `hash` says, or does not unpack to `raw` bytes.
Result<std::string> checkedText(std::span<const std::byte> packed, std::uint64_t raw, const std::string& hash,
                                const std::string& name);

}  // namespace acentric::walk_format
