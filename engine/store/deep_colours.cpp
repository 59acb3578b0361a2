#include "engine/store/deep_colours.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "engine/store/difference_model.h"
#include "engine/store/pixels_around.h"
#include "engine/store/range_coder.h"

namespace acentric {
namespace {

constexpr int kReach = 2;  ///< pixels
/// Of neighbours on the same plane, by how many columns and rows they are away.
constexpr int kWeights[kReach + 1][kReach + 1] = {{8, 4, 2}, {4, 3, 2}, {2, 2, 1}};
/// Of neighbours on other planes: those that are as deep in their pixels count more.
constexpr int kAsDeep = 4;

/// What coding a sample goes by.
struct Prediction {
  std::array<int, 3> colour{};
  std::size_t unrest = 0;  ///< depends on no colour, so that the stream can be read before the picture is
};
constexpr std::size_t kUnrests = 11;

/// Walks the deeper samples, writing or filling their codes.
template <class Coder>
class DeepColourWalk {
 public:
  DeepColourWalk(Coder& coder, const CaptureSamples& samples, const DeepColourShape& shape,
                 std::vector<ColourCodes>& codes)
      : coder_(coder),
        samples_(samples),
        codes_(codes),
        mostCode_(shape.mostCode),
        off_(samples.sampleCount(), 0) {
    const DeepColourSteps steps(shape.quality);
    steps_ = {steps.luma, steps.chroma, steps.chroma};
    pixels_.fill(std::vector<std::uint32_t>(std::size_t(shape.rows) + 1, 0));
  }

  void walk() {
    const std::size_t columns = samples_.columnStart.size() - 1;
    for (std::size_t column = 0; column < columns + kReach; ++column) {
      std::ranges::rotate(pixels_, pixels_.begin() + 1);
      if (column < columns)
        findPixels(samples_, column, pixels_.back());
      else
        std::ranges::fill(pixels_.back(), 0);
      if (column >= kReach) walkColumn();
    }
  }

 private:
  void walkColumn() {
    const std::vector<std::uint32_t>& own = pixels_[kReach];
    for (int row = 0; row + 1 < int(own.size()); ++row)
      for (std::uint32_t i = own[std::size_t(row)] + 1; i < own[std::size_t(row) + 1]; ++i) code(i, row);
  }

  void code(std::uint32_t i, int row) {
    const Prediction prediction = predict(i, row);
    std::size_t lumaOff = 0;
    for (std::size_t p = 0; p < 3; ++p) {
      const int step = steps_[p], expected = prediction.colour[p];
      const int off = int(codes_[i][p]) - expected;
      const int steps = (std::abs(off) + step / 2) / step;
      const std::int64_t coded =
          differences_[p].code(coder_, off < 0 ? -steps : steps, prediction.unrest, lumaOff);
      codes_[i][p] = std::uint16_t(std::clamp<std::int64_t>(expected + coded * step, 0, mostCode_));
      if (p > 0) continue;
      off_[i] = std::uint8_t(std::min<std::int64_t>(std::abs(coded), 255));
      lumaOff = std::min<std::size_t>(off_[i], kLumaOffs - 1);
    }
  }

  PixelRange pixelAt(int across, int row) const {
    const std::vector<std::uint32_t>& column = pixels_[std::size_t(kReach + across)];
    if (row < 0 || row + 1 >= int(column.size())) return {};
    return {column[std::size_t(row)], column[std::size_t(row) + 1]};
  }
  /// visit(sample, is it the first of its pixel, layer) of those that are read before sample i.
  template <class Visit>
  void forKnown(std::uint32_t i, const PixelRange& pixel, const Visit& visit) const {
    for (std::uint32_t j = pixel.first; j < pixel.end; ++j) {
      if (j > pixel.first && j >= i) break;
      visit(j, j == pixel.first, j - pixel.first);
    }
  }
  bool areAlike(std::uint32_t i, std::uint32_t layer, std::uint32_t j, std::uint32_t itsLayer) const {
    return samples_.hasSilhouettes() ? samples_.plane[i] == samples_.plane[j] : layer == itsLayer;
  }

  Prediction predict(std::uint32_t i, int row) const {
    const std::uint32_t layer = i - pixelAt(0, row).first;
    std::array<int, 3> sum{}, sumOfOthers{};
    int weight = 0, weightOfOthers = 0, alike = 0, deep = 0, off = 0;
    const auto add = [&](std::array<int, 3>& to, std::uint32_t j, int times) {
      for (std::size_t p = 0; p < 3; ++p) to[p] += times * codes_[j][p];
    };
    for (int reach = 1; reach <= kReach && weight == 0; ++reach)
      for (int x = -reach; x <= reach; ++x)
        for (int y = -reach; y <= reach; ++y)
          forKnown(i, pixelAt(x, row + y), [&](std::uint32_t j, bool isFirst, std::uint32_t itsLayer) {
            if (areAlike(i, layer, j, itsLayer)) {
              const int times = kWeights[std::abs(x)][std::abs(y)];
              weight += times, ++alike;
              add(sum, j, times);
              if (!isFirst) ++deep, off += off_[j];
            } else if (reach == 1) {
              const int times = itsLayer == layer ? kAsDeep : 1;
              weightOfOthers += times;
              add(sumOfOthers, j, times);
            }
          });
    if (weight == 0) sum = sumOfOthers, weight = weightOfOthers;  // the first of its pixel, at least
    Prediction prediction;
    for (std::size_t p = 0; p < 3; ++p) prediction.colour[p] = (sum[p] + weight / 2) / weight;
    prediction.unrest = alike == 0 ? 10 : deep == 0 ? unrestOfFirst(alike) : unrestOf(off, deep);
    return prediction;
  }
  /// By how many steps deep neighbours were off.
  static std::size_t unrestOf(int off, int neighbours) {
    if (off == 0) return neighbours > 1 ? 0 : 1;
    return off <= neighbours       ? 2
           : off <= 2 * neighbours ? 3
           : off < 4 * neighbours  ? 4
           : off < 8 * neighbours  ? 5
                                   : 6;
  }
  /// Of first samples alone: by how many they are.
  static std::size_t unrestOfFirst(int neighbours) { return neighbours < 2 ? 7 : neighbours < 4 ? 8 : 9; }

  static constexpr std::size_t kLumaOffs = 4;
  Coder& coder_;
  const CaptureSamples& samples_;
  std::vector<ColourCodes>& codes_;
  int mostCode_;
  std::array<int, 3> steps_{};
  std::vector<std::uint8_t> off_;  ///< steps that the luma of a deeper sample was off by
  /// Where pixels begin, of the column that is walked in the middle and of those beside it.
  std::array<std::vector<std::uint32_t>, 2 * kReach + 1> pixels_;
  std::array<DifferenceModel<kUnrests, kLumaOffs>, 3> differences_;
};

}  // namespace

std::vector<std::byte> codeDeepColours(const CaptureSamples& samples, const DeepColourShape& shape,
                                       std::vector<ColourCodes>& codes) {
  RangeWriter writer;
  DeepColourWalk(writer, samples, shape, codes).walk();
  return std::move(writer).finish();
}

Status decodeDeepColours(std::span<const std::byte> bytes, const CaptureSamples& samples,
                         const DeepColourShape& shape, std::vector<ColourCodes>& codes) {
  RangeReader reader(bytes);
  DeepColourWalk(reader, samples, shape, codes).walk();
  if (!reader.atEnd())
    return fail(ErrorKind::malformed, "its colours take more or fewer bytes than there are");
  return {};
}

}  // namespace acentric
