#include "engine/export/walk_format.h"

#include <fmt/format.h>

#include <cstring>

#include "engine/base/hash.h"
#include "engine/store/packed_text.h"

namespace acentric::walk_format {
namespace {

constexpr std::size_t kHashAt = kHeaderBytes - 16;

ContentKey hashOf(std::span<const std::byte> bytes) {
  return Hasher().bytes(bytes.data(), bytes.size()).finish();
}

}  // namespace

HeaderBytes headerBytes(const Header& header) {
  HeaderBytes bytes{};
  std::memcpy(bytes.data(), kMagic.data(), kMagic.size());
  std::memcpy(bytes.data() + 8, &kVersion, sizeof kVersion);
  static_assert(16 + sizeof(Header) == kHashAt);
  std::memcpy(bytes.data() + 16, &header, sizeof header);
  const ContentKey hash = hashOf(std::span(bytes).first(kHashAt));
  std::memcpy(bytes.data() + kHashAt, &hash, 16);
  return bytes;
}

Result<Header> headerOf(std::span<const std::byte> bytes, const std::string& name) {
  const auto malformed = [&](std::string message) {
    return fail(ErrorKind::malformed, std::move(message), name);
  };
  if (bytes.size() < kHeaderBytes || std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) != 0)
    return malformed("is no walk");
  std::uint32_t version = 0;
  std::memcpy(&version, bytes.data() + 8, sizeof version);
  if (version != kVersion)
    return fail(
        ErrorKind::unsupported,
        fmt::format("has version {}, and this program reads {}: export the walk anew", version, kVersion),
        name);
  const ContentKey hash = hashOf(bytes.first(kHashAt));
  if (std::memcmp(bytes.data() + kHashAt, &hash, 16) != 0) return malformed("its header is damaged");
  Header header;
  std::memcpy(&header, bytes.data() + 16, sizeof header);
  const bool sound = header.rootBytes <= kMostRootBytes && header.rootRaw <= kMostRootBytes &&
                     header.pageStart == kHeaderBytes + header.rootBytes &&
                     header.dataStart >= header.pageStart && header.fileBytes >= header.dataStart;
  if (!sound) return malformed("its header makes no sense");
  return header;
}

std::string hashText(std::span<const std::byte> bytes) { return hashOf(bytes).toHex(); }

Result<std::string> checkedText(std::span<const std::byte> packed, std::uint64_t raw, const std::string& hash,
                                const std::string& name) {
  if (hashText(packed) != hash)
    return fail(ErrorKind::malformed, "is damaged: its contents do not fit its hash", name);
  auto text = unpackedText(packed, raw);
  if (!text) return fail(ErrorKind::malformed, "does not unpack to what the walk says", name);
  return std::move(*text);
}

}  // namespace acentric::walk_format
