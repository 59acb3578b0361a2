#pragma once
/// What harnesses share. Each is one function that any bytes may be given to: run_seeds.cpp gives it some,
/// and in the preset "fuzz" libFuzzer does (libfuzzer.cpp).

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/hash.h"

/// The harness's reader takes these bytes, or refuses them with an error.
bool accepts(const std::uint8_t* data, std::size_t size);

namespace acentric::test {

inline std::vector<std::byte> bytesOf(const std::uint8_t* data, std::size_t size) {
  const auto* bytes = reinterpret_cast<const std::byte*>(data);
  return {bytes, bytes + size};
}

/// A block file as damage that its checksum and its size do not tell would leave it: both are put right.
inline std::vector<std::byte> withChecksum(const std::uint8_t* data, std::size_t size) {
  std::vector<std::byte> bytes = bytesOf(data, size);
  constexpr std::size_t kSizeAt = 32, kChecksum = 16;
  if (size < 72) return bytes;
  const std::uint64_t fileBytes = size;
  std::memcpy(bytes.data() + kSizeAt, &fileBytes, sizeof fileBytes);
  const ContentKey sum = Hasher().bytes(bytes.data(), size - kChecksum).finish();
  std::memcpy(bytes.data() + size - kChecksum, &sum.high, 8);
  std::memcpy(bytes.data() + size - kChecksum + 8, &sum.low, 8);
  return bytes;
}

/// A file in memory, for what reads from a path.
class MemoryFile {
 public:
  explicit MemoryFile(const std::vector<std::byte>& bytes) : file_(::memfd_create("fuzz", MFD_CLOEXEC)) {
    for (std::size_t at = 0; at < bytes.size();) {
      const auto written = ::write(file_, bytes.data() + at, bytes.size() - at);
      if (written <= 0) break;
      at += std::size_t(written);
    }
  }
  ~MemoryFile() { ::close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

}  // namespace acentric::test
