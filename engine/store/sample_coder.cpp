#include "engine/store/sample_coder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "engine/store/distance_model.h"
#include "engine/store/range_coder.h"

namespace acentric {
namespace {

constexpr std::uint16_t kHalfOne = 0x3c00;
constexpr std::size_t kNone = ~std::size_t(0);

/// How many samples lie in each pixel, column by column: from the counts of pixels around it.
template <class Coder>
class CountModel {
 public:
  CountModel(Coder& coder, int rows)
      : coder_(coder), now_(std::size_t(rows) + kBorder), before_(now_), beforeThat_(now_) {}

  void beginColumn() {
    std::swap(beforeThat_, before_);
    std::swap(before_, now_);
    std::ranges::fill(now_, 0);
  }
  /// `most`: how many samples are left.
  std::uint32_t code(int row, std::uint32_t count, std::size_t most) {
    const std::size_t at = std::size_t(row) + 2;
    const std::uint32_t n = now_[at - 1], w = before_[at], nw = before_[at - 1], sw = before_[at + 1];
    std::uint32_t level = 0;
    while (level < most) {
      const std::uint32_t around = std::uint32_t(n > level) | std::uint32_t(w > level) << 1 |
                                   std::uint32_t(nw > level) << 2 | std::uint32_t(sw > level) << 3 |
                                   std::uint32_t(now_[at - 2] > level) << 4 |
                                   std::uint32_t(beforeThat_[at] > level) << 5;
      if (!coder_.bit(more_[std::min(level, kLevels - 1)][around], count > level)) break;
      ++level;
    }
    return now_[at] = level;
  }

 private:
  static constexpr std::size_t kBorder = 3;
  static constexpr std::uint32_t kLevels = 6;
  Coder& coder_;
  std::array<std::array<BitChance, 64>, kLevels> more_;
  std::vector<std::uint32_t> now_, before_, beforeThat_;
};

/// A number that is mostly that of the sample above or of the one in the column before.
template <class Coder, std::size_t kBits>
class LikeNeighbours {
 public:
  /// Of neighbours that are not there any number, twice the same.
  std::uint32_t code(Coder& coder, std::uint32_t value, std::uint32_t above, std::uint32_t before) {
    const std::size_t alike = above == before ? 1 : 0;
    std::uint8_t& past = past_[alike];
    const bool like = coder.bit(likeBefore_[alike][past & 7u], value == before);
    past = std::uint8_t(past << 1 | (like ? 1 : 0));
    if (like) return before;
    if (alike == 0 && coder.bit(likeAbove_, value == above)) return above;
    std::uint32_t out = 0;
    for (std::size_t byte = kBits / 8; byte-- > 0;) {
      std::uint32_t tree = 1;
      for (std::size_t b = 8; b-- > 0;)
        tree = tree << 1 | std::uint32_t(coder.bit(trees_[byte][tree], (value >> (8 * byte + b) & 1u) != 0));
      out = out << 8 | (tree & 0xffu);
    }
    return out;
  }

 private:
  std::array<std::array<BitChance, 8>, 2> likeBefore_;
  BitChance likeAbove_;
  std::array<std::uint8_t, 2> past_{};
  std::array<std::array<BitChance, 256>, kBits / 8> trees_;
};

/// Of one column where each pixel's samples begin; behind the last row the end.
void findPixels(const CaptureSamples& samples, std::size_t column, std::vector<std::uint32_t>& first) {
  std::uint32_t at = samples.columnStart[column];
  const std::uint32_t end = samples.columnStart[column + 1];
  for (std::size_t row = 0; row < first.size(); ++row) {
    first[row] = at;
    while (at < end && samples.row[at] == row) ++at;
  }
}

/// Walks the samples of a list whose pixels are known, writing or filling the other arrays.
template <class Coder, class Samples>
class AttributeWalk {
 public:
  AttributeWalk(Coder& coder, Samples& samples, const SampleShape& shape)
      : coder_(coder),
        samples_(samples),
        shape_(shape),
        distances_(coder, shape.distanceStep),
        now_(std::size_t(shape.rows) + 1),
        before_(now_) {}

  bool walk() {
    for (std::size_t column = 0; column < std::size_t(shape_.columns); ++column) {
      std::swap(before_, now_);
      findPixels(samples_, column, now_);
      distances_.beginColumn(samples_.columnStart[column],
                             samples_.columnStart[column + 1] - samples_.columnStart[column]);
      for (std::size_t row = 0; row < std::size_t(shape_.rows); ++row)
        for (std::uint32_t i = now_[row]; i < now_[row + 1]; ++i)
          if (!codeSample(i, above(row, i), besides(column, row, i), i > now_[row] ? i - 1 : kNone))
            return false;
    }
    return true;
  }

 private:
  std::size_t above(std::size_t row, std::uint32_t i) const {
    if (row == 0 || now_[row - 1] == now_[row]) return kNone;
    return std::min(now_[row - 1] + (i - now_[row]), now_[row] - 1);
  }
  std::size_t besides(std::size_t column, std::size_t row, std::uint32_t i) const {
    if (column == 0 || before_[row] == before_[row + 1]) return kNone;
    return std::min(before_[row] + (i - now_[row]), before_[row + 1] - 1);
  }

  template <class Model, class Array>
  void codeLike(Model& model, Array& array, std::size_t i, std::size_t above, std::size_t before,
                std::uint32_t otherwise) {
    if (above == kNone) above = before;
    if (before == kNone) before = above;
    const std::uint32_t a = above == kNone ? otherwise : array[above],
                        b = before == kNone ? otherwise : array[before];
    const std::uint32_t value = model.code(coder_, array[i], a, b);
    if constexpr (Coder::kReads) array[i] = static_cast<typename Array::value_type>(value);
  }

  bool codeSample(std::size_t i, std::size_t above, std::size_t before, std::size_t inFront) {
    const auto w = distances_.code(samples_.inverseDistance[i], i, above, before, inFront);
    if constexpr (Coder::kReads) {
      if (!w) return false;
      samples_.inverseDistance[i] = *w;
    }
    codeLike(roles_, samples_.roles, i, above, before, 1);
    codeAlpha(i, above, before);
    if (shape_.mirrors) codeLike(mirrors_, samples_.mirror, i, above, before, 0);
    if (shape_.planes > 0) {
      codeLike(coverages_, samples_.coverage, i, kNone, kNone, kWholePixel);
      codePlane(i, above, before);
      if (samples_.plane[i] >= shape_.planes) return false;
    }
    return true;
  }

  void codeAlpha(std::size_t i, std::size_t above, std::size_t before) {
    const auto of = [&](std::size_t n) -> std::uint32_t {
      return n == kNone ? kHalfOne : std::uint32_t(samples_.colour[n].a);
    };
    const std::uint32_t alpha = alphas_.code(coder_, samples_.colour[i].a, of(above), of(before));
    if constexpr (Coder::kReads) samples_.colour[i].a = std::uint16_t(alpha);
  }

  /// Planes are mostly met in the order of their numbers.
  void codePlane(std::size_t i, std::size_t above, std::size_t before) {
    const std::uint32_t value = samples_.plane[i];
    const std::uint32_t next = nextPlane_;
    const auto of = [&](std::size_t n) { return n == kNone ? next : samples_.plane[n]; };
    const bool isNext = coder_.bit(nextPlanes_, value == next);
    const std::uint32_t coded = isNext ? next : planes_.code(coder_, value, of(above), of(before));
    nextPlane_ = std::max(nextPlane_, coded == ~0u ? coded : coded + 1);
    if constexpr (Coder::kReads) samples_.plane[i] = coded;
  }

  Coder& coder_;
  Samples& samples_;
  const SampleShape& shape_;
  DistanceModel<Coder> distances_;
  LikeNeighbours<Coder, 8> roles_, mirrors_;
  LikeNeighbours<Coder, 16> alphas_, coverages_;
  LikeNeighbours<Coder, 32> planes_;
  BitChance nextPlanes_;
  std::uint32_t nextPlane_ = 0;
  std::vector<std::uint32_t> now_, before_;  ///< where pixels begin
};

tl::unexpected<Error> malformed(const char* message) { return fail(ErrorKind::malformed, message); }

}  // namespace

double codedStep(const CaptureSamples& samples, double distanceStep) {
  int exponent = 0;
  if (!(distanceStep > 0) || std::frexp(distanceStep, &exponent) != 0.5) return 0;
  const double most = double(kMostDistanceNumbers) * distanceStep;
  const bool multiples = std::ranges::all_of(samples.inverseDistance, [&](float w) {
    const double number = double(w) / distanceStep;
    return double(w) <= most && number == std::floor(number);
  });
  return multiples ? distanceStep : 0;
}

std::vector<std::byte> codeSamples(const CaptureSamples& samples, const SampleShape& shape) {
  RangeWriter writer;
  CountModel counts(writer, shape.rows);
  std::size_t left = shape.samples;
  for (std::size_t column = 0; column < std::size_t(shape.columns); ++column) {
    counts.beginColumn();
    std::uint32_t at = samples.columnStart[column];
    const std::uint32_t end = samples.columnStart[column + 1];
    for (int row = 0; row < shape.rows; ++row) {
      const std::uint32_t first = at;
      while (at < end && samples.row[at] == row) ++at;
      left -= counts.code(row, at - first, left);
    }
  }
  AttributeWalk(writer, samples, shape).walk();
  return std::move(writer).finish();
}

Status decodeSamples(std::span<const std::byte> bytes, const SampleShape& shape, CaptureSamples& out) {
  RangeReader reader(bytes);
  out.row.reserve(shape.samples);
  out.columnStart.assign(1, 0);
  out.columnStart.reserve(std::size_t(shape.columns) + 1);
  CountModel counts(reader, shape.rows);
  std::size_t left = shape.samples;
  for (int column = 0; column < shape.columns; ++column) {
    counts.beginColumn();
    for (int row = 0; row < shape.rows; ++row) {
      const std::uint32_t count = counts.code(row, 0, left);
      out.row.insert(out.row.end(), count, std::uint16_t(row));
      left -= count;
    }
    out.columnStart.push_back(std::uint32_t(out.row.size()));
  }
  if (left > 0) return malformed("its pixels hold fewer samples than it has");
  out.inverseDistance.resize(shape.samples);
  out.colour.resize(shape.samples);
  out.roles.resize(shape.samples);
  out.mirror.resize(shape.mirrors ? shape.samples : 0);
  out.coverage.resize(shape.planes > 0 ? shape.samples : 0);
  out.plane.resize(shape.planes > 0 ? shape.samples : 0);
  if (!AttributeWalk(reader, out, shape).walk()) return malformed("a sample's numbers are out of range");
  if (!reader.atEnd()) return malformed("its samples take more or fewer bytes than there are");
  return {};
}

}  // namespace acentric
