#pragma once
/// What became of what a capture's rays met.

#include <array>
#include <cstdint>
#include <numeric>

namespace acentric {

/// Of one capture or more.
struct SampleCounts {
  static constexpr std::size_t kLayers = 8;
  std::array<std::uint64_t, kLayers>
      kept{};                    ///< surfaces by place in the pixel, nearest first; the last: and farther
  std::uint64_t background = 0;  ///< pixels that show it behind all samples
  std::uint64_t hidden = 0;      ///< no region sees them
  std::uint64_t overLimit = 0;   ///< more layers than the settings allow
  std::uint64_t keptInAll() const { return std::accumulate(kept.begin(), kept.end(), std::uint64_t(0)); }
  bool operator==(const SampleCounts&) const = default;
  SampleCounts& operator+=(const SampleCounts& other) {
    for (std::size_t layer = 0; layer < kLayers; ++layer) kept[layer] += other.kept[layer];
    background += other.background;
    hidden += other.hidden;
    overLimit += other.overLimit;
    return *this;
  }
};

}  // namespace acentric
