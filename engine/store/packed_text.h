#pragma once
/// Text packed by zstd.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace acentric {

/// Of zstd; what is written once and read often is worth a high one.
inline constexpr int kUsualTextLevel = 15;

std::vector<std::byte> packedText(const std::string& text, int level = kUsualTextLevel);
/// Nothing where it does not unpack to so many bytes.
std::optional<std::string> unpackedText(std::span<const std::byte> packed, std::uint64_t bytes);

}  // namespace acentric
