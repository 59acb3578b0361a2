#pragma once
/// OpenEXR files in memory: what is written reaches the disk in one atomic step, with its errors seen.

#include <OpenEXR/ImfIO.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace acentric {

class ExrMemoryOutput : public Imf::OStream {
 public:
  explicit ExrMemoryOutput(const std::string& name) : Imf::OStream(name.c_str()) {}
  void write(const char bytes[], int count) override;
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }
  /// All that was written, in blocks.
  std::vector<std::span<const std::byte>> parts() const;

 private:
  std::vector<std::vector<std::byte>> blocks_;  ///< all of one size: they grow without being copied
  std::uint64_t size_ = 0, position_ = 0;
};

}  // namespace acentric
