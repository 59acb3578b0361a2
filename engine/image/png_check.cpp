#include "engine/image/png_check.h"

#include <array>
#include <cstdint>

namespace acentric {
namespace {

constexpr std::size_t kSignatureBytes = 8;
constexpr std::size_t kChunkOverhead = 12;  // length, type, checksum

constexpr std::array<std::uint32_t, 256> crcTable() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t n = 0; n < 256; ++n) {
    std::uint32_t value = n;
    for (int bit = 0; bit < 8; ++bit) value = value & 1 ? 0xedb88320u ^ (value >> 1) : value >> 1;
    table[n] = value;
  }
  return table;
}

/// CRC-32 as PNG's specification defines it (ISO 3309).
std::uint32_t crcOf(std::span<const std::byte> bytes) {
  static constexpr std::array<std::uint32_t, 256> kTable = crcTable();
  std::uint32_t crc = 0xffffffffu;
  for (const std::byte byte : bytes)
    crc = kTable[(crc ^ std::to_integer<std::uint32_t>(byte)) & 0xff] ^ (crc >> 8);
  return ~crc;
}

std::uint32_t bigEndian(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
  return value;
}

}  // namespace

Status checkPng(std::span<const std::byte> bytes, const std::string& name) {
  constexpr std::uint32_t kEnd = 0x49454e44;  // "IEND"
  std::size_t at = kSignatureBytes;
  while (bytes.size() >= at + kChunkOverhead) {
    const std::size_t length = bigEndian(bytes, at);
    if (length > bytes.size() - at - kChunkOverhead) break;
    const std::uint32_t type = bigEndian(bytes, at + 4);
    const bool critical = (type & 0x20000000u) == 0;  // an upper-case first letter
    if (critical && crcOf(bytes.subspan(at + 4, 4 + length)) != bigEndian(bytes, at + 8 + length))
      return fail(ErrorKind::malformed, "is damaged: a PNG checksum differs", name);
    if (type == kEnd) return {};
    at += kChunkOverhead + length;
  }
  return fail(ErrorKind::malformed, "is cut off: the PNG's end is missing", name);
}

}  // namespace acentric
