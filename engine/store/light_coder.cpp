#include "engine/store/light_coder.h"

#include <algorithm>
#include <array>
#include <bit>

#include "engine/store/difference_model.h"

namespace acentric {
namespace {

constexpr std::array kChannels = {&HalfColour::g, &HalfColour::r, &HalfColour::b};  ///< as they are coded
constexpr std::uint16_t kOne = 0x3c00;
constexpr int kInfinite = 0x7c00;
constexpr int kMostUnused = 4;

/// Writer and reader in one, as the coder is.
template <class Coder>
class LightCoder {
 public:
  LightCoder(Coder& coder, int unusedBits) : coder_(coder), shift_(unusedBits) {}

  /// One side of a triangle. False where what is read is no light.
  template <class Sample>
  bool code(Sample* samples, std::uint32_t resolution) {
    resolution_ = resolution;
    for (Channel& channel : channels_) {
      channel.value.assign(surfaceSampleCount(resolution), 0);
      channel.off.assign(channel.value.size(), 0);
    }
    for (std::uint32_t i = 0; i <= resolution; ++i)
      for (std::uint32_t j = 0; i + j <= resolution; ++j)
        if (!codeSample(samples[surfaceSampleIndex(resolution, i, j)], i, j)) return false;
    for (Channel& channel : channels_) channel.last = channel.value.front();
    return true;
  }

 private:
  struct Channel {
    std::vector<int> value,
        off;       ///< of the triangle's side: as coded, and what that is apart from the foretold
    int last = 0;  ///< the first value of the side before
    DifferenceModel<30> model;
  };
  struct Guess {
    int value = 0, unrest = 0;
  };

  template <class Sample>
  bool codeSample(Sample& sample, std::uint32_t i, std::uint32_t j) {
    const std::size_t own = surfaceSampleIndex(resolution_, i, j);
    std::array<int, 3> moved{};  // from what the samples around foretell
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      Channel& channel = channels_[c];
      const Guess around = guess(channel, i, j);
      const int along = c == 0 ? 0 : c == 1 ? moved[0] : (moved[0] + moved[1]) / 2;
      const int foretold = std::max(around.value + along, 0);
      std::size_t unrest = std::min<std::size_t>(widthOf(around.unrest), 9);
      if (c > 0)
        unrest = 3 * unrest + std::min<std::size_t>(widthOf(c == 1 ? moved[0] : channels_[1].off[own]), 2);
      if constexpr (!Coder::kReads) channel.value[own] = sample.*kChannels[c] >> shift_;
      const std::int64_t off = channel.model.code(coder_, channel.value[own] - foretold, unrest);
      if (off < -foretold || off >= (kInfinite >> shift_) - foretold) return false;
      channel.off[own] = int(off), channel.value[own] = foretold + int(off);
      moved[c] = channel.value[own] - around.value;
      if constexpr (Coder::kReads) sample.*kChannels[c] = std::uint16_t(channel.value[own] << shift_);
    }
    if constexpr (Coder::kReads) sample.a = kOne;
    return true;
  }

  /// From the samples around: where three of them are known, the plane through them, within their range
  /// (Martucci 1990). Unrest: by how much these were off.
  Guess guess(const Channel& channel, std::uint32_t i, std::uint32_t j) const {
    const std::size_t own = surfaceSampleIndex(resolution_, i, j);
    const auto& [value, off, last, model] = channel;
    if (i == 0 && j == 0) return {last, 0};
    if (i == 0) return {value[own - 1], 2 * std::abs(off[own - 1])};
    const std::size_t above = surfaceSampleIndex(resolution_, i - 1, j);
    const int unrest = std::abs(off[above]) + std::abs(off[above + 1]);
    if (j == 0) return {i > 1 ? value[above] : (value[above] + value[above + 1]) / 2, unrest};
    const int before = value[own - 1], up = value[above], corner = value[above - 1];
    const auto [low, high] = std::minmax(before, up);
    return {std::clamp(before + up - corner, low, high), unrest + 2 * std::abs(off[own - 1])};
  }

  static std::size_t widthOf(int number) { return std::size_t(std::bit_width(unsigned(std::abs(number)))); }

  Coder& coder_;
  int shift_;
  std::uint32_t resolution_ = 0;
  std::array<Channel, 3> channels_;
};

/// visit(first sample, resolution) for all sides that have light; false as soon as it is.
template <class Visit>
bool forSides(const SurfaceLight& light, const Visit& visit) {
  for (std::size_t t = 0; t < light.resolution.size(); ++t) {
    const std::uint32_t resolution = light.resolution[t];
    if (resolution == 0) continue;
    const std::size_t first = light.firstSample[t];
    if (!visit(first, resolution)) return false;
    if (light.hasBack[t] != 0 && !visit(first + surfaceSampleCount(resolution), resolution)) return false;
  }
  return true;
}

}  // namespace

int unusedBits(const SurfaceLight& light) {
  unsigned used = 1u << kMostUnused;
  for (const HalfColour& colour : light.light) used |= unsigned(colour.r) | colour.g | colour.b;
  return std::countr_zero(used);
}

std::vector<std::byte> codeLight(const SurfaceLight& light, int unusedBits) {
  RangeWriter writer;
  LightCoder<RangeWriter> coder(writer, unusedBits);
  forSides(light, [&](std::size_t first, std::uint32_t resolution) {
    return coder.code(light.light.data() + first, resolution);
  });
  return std::move(writer).finish();
}

Status decodeLight(std::span<const std::byte> stream, int unusedBits, SurfaceLight& light) {
  const auto malformed = [] {
    return fail(ErrorKind::malformed, "its stream makes no sense", "surface light");
  };
  if (unusedBits < 0 || unusedBits > kMostUnused) return malformed();
  RangeReader reader(stream);
  LightCoder<RangeReader> coder(reader, unusedBits);
  const bool sound = forSides(light, [&](std::size_t first, std::uint32_t resolution) {
    return coder.code(light.light.data() + first, resolution);
  });
  return sound && reader.atEnd() ? Status() : Status(malformed());
}

}  // namespace acentric
