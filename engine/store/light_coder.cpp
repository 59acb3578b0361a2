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
constexpr int kMostUnused = 5;

/// Writer and reader in one, as the coder is, of the fronts of triangles or of their backs.
template <class Coder>
class SideCoder {
 public:
  SideCoder(Coder& coder, int unusedBits) : coder_(coder), shift_(unusedBits) {}

  /// That of one triangle. False where what is read is no light.
  template <class Sample>
  bool code(Sample* samples, std::uint32_t resolution) {
    for (std::uint32_t i = 0; i <= resolution; ++i) {
      for (Channel& channel : channels_) {
        std::swap(channel.above, channel.row);
        channel.row.resize(resolution + 1 - i);
      }
      for (std::uint32_t j = 0; i + j <= resolution; ++j)
        if (!codeSample(samples[surfaceSampleIndex(resolution, i, j)], i, j)) return false;
      if (i == 0)
        for (Channel& channel : channels_) channel.last = channel.row.front().value;
    }
    return true;
  }

 private:
  struct Trace {
    int value = 0, off = 0;  ///< as coded, and what that is apart from the foretold
  };
  struct Channel {
    std::vector<Trace> row, above;  ///< of samples with the same i, and with the one before
    int last = 0;                   ///< the first value of the triangle before
    DifferenceModel<30> model;
  };
  struct Guess {
    int value = 0, unrest = 0;
  };

  template <class Sample>
  bool codeSample(Sample& sample, std::uint32_t i, std::uint32_t j) {
    std::array<int, 3> moved{};  // from what the samples around foretell
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      Channel& channel = channels_[c];
      Trace& own = channel.row[j];
      const Guess around = guess(channel, i, j);
      const int along = c == 0 ? 0 : c == 1 ? moved[0] : (moved[0] + moved[1]) / 2;
      const int foretold = std::max(around.value + along, 0);
      std::size_t unrest = std::min<std::size_t>(widthOf(around.unrest), 9);
      if (c > 0)
        unrest = 3 * unrest + std::min<std::size_t>(widthOf(c == 1 ? moved[0] : channels_[1].row[j].off), 2);
      const int value = Coder::kReads ? 0 : sample.*kChannels[c] >> shift_;
      const std::int64_t off = channel.model.code(coder_, value - foretold, unrest);
      if (off < -foretold || off >= (kInfinite >> shift_) - foretold) return false;
      own = {foretold + int(off), int(off)};
      moved[c] = own.value - around.value;
      if constexpr (Coder::kReads) sample.*kChannels[c] = std::uint16_t(own.value << shift_);
    }
    if constexpr (Coder::kReads) sample.a = kOne;
    return true;
  }

  /// From the samples around: where three of them are known, the plane through them, within their range
  /// (Martucci 1990). Unrest: by how much these were off.
  static Guess guess(const Channel& channel, std::uint32_t i, std::uint32_t j) {
    const auto& [row, above, last, model] = channel;
    if (i == 0 && j == 0) return {last, 0};
    if (i == 0) return {row[j - 1].value, 2 * std::abs(row[j - 1].off)};
    const Trace &up = above[j], &next = above[j + 1];
    const int unrest = std::abs(up.off) + std::abs(next.off);
    if (j == 0) return {i > 1 ? up.value : (up.value + next.value) / 2, unrest};
    const Trace& before = row[j - 1];
    const auto [low, high] = std::minmax(before.value, up.value);
    return {std::clamp(before.value + up.value - above[j - 1].value, low, high),
            unrest + 2 * std::abs(before.off)};
  }

  static std::size_t widthOf(int number) { return std::size_t(std::bit_width(unsigned(std::abs(number)))); }

  Coder& coder_;
  int shift_;
  std::array<Channel, 3> channels_;
};

/// Backs have little in common with the fronts they lie behind: the two know nothing of each other. False
/// where what is read is no light.
template <class Coder, class Samples>
bool codeSides(Coder& coder, int unusedBits, const SurfaceLight& tables, Samples* samples) {
  std::array sides{SideCoder(coder, unusedBits), SideCoder(coder, unusedBits)};
  for (std::size_t t = 0; t < tables.resolution.size(); ++t) {
    const std::uint32_t resolution = tables.resolution[t];
    if (resolution == 0) continue;
    Samples* const front = samples + tables.firstSample[t];
    if (!sides[0].code(front, resolution)) return false;
    if (tables.hasBack[t] != 0 && !sides[1].code(front + surfaceSampleCount(resolution), resolution))
      return false;
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
  codeSides(writer, unusedBits, light, light.light.data());
  return std::move(writer).finish();
}

Status decodeLight(std::span<const std::byte> stream, int unusedBits, SurfaceLight& light) {
  const auto malformed = [] {
    return fail(ErrorKind::malformed, "its stream makes no sense", "surface light");
  };
  if (unusedBits < 0 || unusedBits > kMostUnused) return malformed();
  RangeReader reader(stream);
  const bool sound = codeSides(reader, unusedBits, light, light.light.data());
  return sound && reader.atEnd() ? Status() : Status(malformed());
}

}  // namespace acentric
