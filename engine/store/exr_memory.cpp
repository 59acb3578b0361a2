#include "engine/store/exr_memory.h"

#include <algorithm>
#include <cstring>

namespace acentric {

namespace {

constexpr std::size_t kBlockBytes = 1 << 20;

}  // namespace

void ExrMemoryOutput::write(const char bytes[], int count) {
  for (std::size_t left = static_cast<std::size_t>(count); left > 0;) {
    const std::size_t block = position_ / kBlockBytes, at = position_ % kBlockBytes;
    while (blocks_.size() <= block) blocks_.emplace_back(kBlockBytes);
    const std::size_t size = std::min(left, kBlockBytes - at);
    std::memcpy(blocks_[block].data() + at, bytes, size);
    bytes += size;
    position_ += size;
    left -= size;
  }
  size_ = std::max(size_, position_);
}

std::vector<std::span<const std::byte>> ExrMemoryOutput::parts() const {
  std::vector<std::span<const std::byte>> parts;
  for (std::size_t block = 0; block < blocks_.size(); ++block)
    parts.push_back({blocks_[block].data(), std::min(kBlockBytes, size_ - block * kBlockBytes)});
  return parts;
}

}  // namespace acentric
