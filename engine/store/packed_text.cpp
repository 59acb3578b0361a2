#include "engine/store/packed_text.h"

#include <zstd.h>

namespace acentric {

std::vector<std::byte> packedText(const std::string& text, int level) {
  std::vector<std::byte> packed(ZSTD_compressBound(text.size()));
  packed.resize(ZSTD_compress(packed.data(), packed.size(), text.data(), text.size(), level));
  return packed;
}

std::optional<std::string> unpackedText(std::span<const std::byte> packed, std::uint64_t bytes) {
  std::string text(bytes, '\0');
  const std::size_t size = ZSTD_decompress(text.data(), text.size(), packed.data(), packed.size());
  if (ZSTD_isError(size) != 0 || size != bytes) return std::nullopt;
  return text;
}

}  // namespace acentric
