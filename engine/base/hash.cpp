#include "engine/base/hash.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <charconv>
#include <cstdio>
#include <vector>

#include "engine/base/contract.h"

namespace acentric {

std::string ContentKey::toHex() const { return fmt::format("{:016x}{:016x}", high, low); }

Result<ContentKey> ContentKey::fromHex(std::string_view text) {
  ContentKey key;
  const auto parse = [](std::string_view part, std::uint64_t& out) {
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), out, 16);
    return error == std::errc{} && end == part.data() + part.size();
  };
  if (text.size() != 32 || !parse(text.substr(0, 16), key.high) || !parse(text.substr(16), key.low))
    return fail(ErrorKind::malformed,
                "a content key has 32 hexadecimal digits, not '" + std::string(text.substr(0, 40)) + "'");
  return key;
}

struct Hasher::State {
  XXH3_state_t* xxh = XXH3_createState();
  State() { XXH3_128bits_reset(xxh); }
  ~State() { XXH3_freeState(xxh); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
};

Hasher::Hasher() : state_(std::make_unique<State>()) {}
Hasher::~Hasher() = default;
Hasher::Hasher(Hasher&&) noexcept = default;
Hasher& Hasher::operator=(Hasher&&) noexcept = default;

Hasher& Hasher::bytes(const void* data, std::size_t size) {
  if (size > 0) XXH3_128bits_update(state_->xxh, data, size);
  return *this;
}

Hasher& Hasher::text(std::string_view value) {
  this->value(static_cast<std::uint64_t>(value.size()));
  return bytes(value.data(), value.size());
}

ContentKey Hasher::finish() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_->xxh);
  return {hash.high64, hash.low64};
}

ContentKey keyOf(const KeyParts& parts) {
  Hasher hasher;
  for (const KeyPart& part : parts) hasher.text(part.name).value(part.key.high).value(part.key.low);
  return hasher.finish();
}

Result<ContentKey> hashFile(const std::filesystem::path& path) {
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) return fail(ErrorKind::notFound, "cannot be opened for reading", path.string());
  Hasher hasher;
  std::vector<char> buffer(1 << 20);
  while (const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), file.get()))
    hasher.bytes(buffer.data(), got);
  if (std::ferror(file.get())) return fail(ErrorKind::unreadable, "reading failed", path.string());
  return hasher.finish();
}

}  // namespace acentric
