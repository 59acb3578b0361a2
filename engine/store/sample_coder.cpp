#include "engine/store/sample_coder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "engine/store/distance_model.h"
#include "engine/store/pixels_around.h"
#include "engine/store/plane_model.h"
#include "engine/store/range_coder.h"

namespace acentric {
namespace {

constexpr std::uint16_t kHalfOne = 0x3c00;

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
    for (std::size_t byte = kBits / 8; byte-- > 0;)
      out = out << 8 | trees_[byte].code(coder, value >> (8 * byte) & 0xffu);
    return out;
  }

 private:
  std::array<std::array<BitChance, 8>, 2> likeBefore_;
  BitChance likeAbove_;
  std::array<std::uint8_t, 2> past_{};
  std::array<BitTree<8>, kBits / 8> trees_;
};

/// Which parts of its pixel each sample covers: where the same plane goes on around it, mostly all; else part
/// by part, each by those before it.
template <class Coder>
class CoverageModel {
 public:
  /// `around`: of the same plane in the pixels around, none where there is none.
  std::uint16_t code(Coder& coder, std::uint16_t value,
                     const std::array<std::optional<std::uint16_t>, PixelsAround::kPlaces>& around) {
    std::size_t context = 0;
    for (const auto& mask : around) context = 3 * context + (!mask ? 0u : *mask == kWholePixel ? 2u : 1u);
    if (coder.bit(whole_[context], value == kWholePixel)) return kWholePixel;
    const auto maskOf = [&](std::size_t place) -> std::uint32_t { return around[place].value_or(0); };
    std::uint32_t mask = 0;
    for (int part = 0; part < kCoverageParts * kCoverageParts; ++part) {
      const int x = part % kCoverageParts, y = part / kCoverageParts;
      const auto at = [&](int column, int row) -> std::uint32_t {
        const std::uint32_t from = column < 0
                                       ? maskOf(row < 0 ? PixelsAround::kAboveBefore : PixelsAround::kBefore)
                                   : row < 0 ? maskOf(PixelsAround::kAbove)
                                             : mask;
        if (column >= kCoverageParts) return 0;
        return from >> (kCoverageParts * (row & 3) + (column & 3)) & 1u;
      };
      const std::uint32_t parts =
          at(x - 1, y) | at(x, y - 1) << 1 | at(x - 1, y - 1) << 2 | at(x + 1, y - 1) << 3;
      mask |= std::uint32_t(coder.bit(part_[std::size_t(part)][parts], (value >> part & 1) != 0)) << part;
    }
    return std::uint16_t(mask);
  }

 private:
  std::array<BitChance, 81> whole_;
  std::array<std::array<BitChance, 16>, kCoverageParts * kCoverageParts> part_;
};

/// Walks the samples of a list whose pixels are known, writing or filling the other arrays.
template <class Coder, class Samples>
class AttributeWalk {
 public:
  AttributeWalk(Coder& coder, Samples& samples, const SampleShape& shape)
      : coder_(coder),
        samples_(samples),
        shape_(shape),
        distances_(coder, shape.distanceStep),
        planes_(coder, shape.planes),
        planeNumbers_(coder, planeStep(shape.distanceStep)),
        isMet_(shape.planes, false),
        numbers_(shape.distanceStep),
        now_(std::size_t(shape.camera.rows) + 1),
        before_(now_) {
    if constexpr (Coder::kReads)
      samples.planes.resize(shape.planes);
    else if (shape.planes > 0)
      reaches_ = planeReaches(samples);
    if (shape.planes > 0)
      for (int row = 0; row < shape.camera.rows; ++row) tangent_.push_back(shape.camera.tangentAt(row + 0.5));
  }

  bool walk() {
    for (std::size_t column = 0; column < std::size_t(shape_.camera.columns); ++column) {
      std::swap(before_, now_);
      findPixels(samples_, column, now_);
      direction_ = shape_.camera.directionAt(double(column) + 0.5);
      distances_.beginColumn(samples_.columnStart[column],
                             samples_.columnStart[column + 1] - samples_.columnStart[column]);
      for (std::size_t row = 0; row < std::size_t(shape_.camera.rows); ++row) {
        if (now_[row] == now_[row + 1]) continue;
        const PixelsAround around = pixelsAround(row);
        for (std::uint32_t i = now_[row]; i < now_[row + 1]; ++i)
          if (!codeSample(i, row, around)) return false;
      }
    }
    for (std::uint32_t plane = 0; plane < shape_.planes; ++plane)
      if (!isMet_[plane] && !codeNewPlane(plane, 0, kNoSample)) return false;
    return true;
  }

 private:
  PixelsAround pixelsAround(std::size_t row) const {
    const auto pixel = [](const std::vector<std::uint32_t>& first, std::size_t r) {
      return PixelRange{first[r], first[r + 1]};
    };
    PixelsAround around;
    around.pixel[PixelsAround::kBefore] = pixel(before_, row);
    if (row > 0) around.pixel[PixelsAround::kAbove] = pixel(now_, row - 1);
    if (row > 0) around.pixel[PixelsAround::kAboveBefore] = pixel(before_, row - 1);
    if (row + 2 < before_.size()) around.pixel[PixelsAround::kBelowBefore] = pixel(before_, row + 1);
    return around;
  }
  /// The sample of a pixel that lies on the plane; none if there is none.
  std::size_t onPlane(const PixelRange& pixel, std::uint32_t plane) const {
    for (std::uint32_t i = pixel.first; i < pixel.end; ++i)
      if (samples_.plane[i] == plane) return i;
    return kNoSample;
  }

  template <class Model, class Array>
  void codeLike(Model& model, Array& array, std::size_t i, std::size_t above, std::size_t before,
                std::uint32_t otherwise) {
    if (above == kNoSample) above = before;
    if (before == kNoSample) before = above;
    const std::uint32_t a = above == kNoSample ? otherwise : array[above],
                        b = before == kNoSample ? otherwise : array[before];
    const std::uint32_t value = model.code(coder_, array[i], a, b);
    if constexpr (Coder::kReads) array[i] = static_cast<typename Array::value_type>(value);
  }

  /// Where the pixel's ray meets a plane; 0 where it does not.
  std::int64_t numberOn(const SurfacePlane& plane, std::size_t row) const {
    constexpr double kMost = 1e9;  // 1/m
    const double w = plane.inverseDistance(direction_, tangent_[row]);
    if (!(w > 0)) return 0;
    return numbers_.numberOf(storedInverseDistance(std::min(w, kMost), shape_.distanceStep));
  }

  bool codeSample(std::uint32_t i, std::size_t row, const PixelsAround& around) {
    const std::uint32_t first = now_[row];
    std::size_t above = around.pixel[PixelsAround::kAbove].at(i - first),
                before = around.pixel[PixelsAround::kBefore].at(i - first);
    std::size_t goesOn = 0;  // in how many of both pixels the plane does
    if (shape_.planes > 0) {
      if (!codePlane(i, row, around, above, before)) return false;
      const std::size_t a = onPlane(around.pixel[PixelsAround::kAbove], samples_.plane[i]),
                        b = onPlane(around.pixel[PixelsAround::kBefore], samples_.plane[i]);
      if (a != kNoSample || b != kNoSample) above = a, before = b;
      goesOn = std::size_t(a != kNoSample) + std::size_t(b != kNoSample);
    }
    const auto w =
        shape_.planes > 0
            ? distances_.codeBeside(numberOn(samples_.planes[samples_.plane[i]], row),
                                    samples_.inverseDistance[i], i, above, before)
            : distances_.code(samples_.inverseDistance[i], i, above, before, i > first ? i - 1 : kNoSample);
    if constexpr (Coder::kReads) {
      if (!w) return false;
      samples_.inverseDistance[i] = *w;
    }
    codeLike(roles_[i > first ? 1 : 0][goesOn], samples_.roles, i, above, before, 1);
    codeAlpha(i, above, before);
    if (shape_.mirrors) codeLike(mirrors_, samples_.mirror, i, above, before, 0);
    return true;
  }

  void codeAlpha(std::size_t i, std::size_t above, std::size_t before) {
    const auto of = [&](std::size_t n) -> std::uint32_t {
      return n == kNoSample ? kHalfOne : std::uint32_t(samples_.colour[n].a);
    };
    const std::uint32_t alpha = alphas_.code(coder_, samples_.colour[i].a, of(above), of(before));
    if constexpr (Coder::kReads) samples_.colour[i].a = std::uint16_t(alpha);
  }

  /// With the parts that the sample covers. False if there is no such plane.
  bool codePlane(std::uint32_t i, std::size_t row, const PixelsAround& around, std::size_t above,
                 std::size_t before) {
    const std::uint32_t first = now_[row];
    const std::uint32_t plane =
        planes_.code(samples_.plane[i], samples_.plane, around, {first, i}, now_[row + 1] - first);
    if (plane >= shape_.planes) return false;
    if (!isMet_[plane]) {
      const std::size_t beside = i > first ? i - 1 : before != kNoSample ? before : above;
      if (!codeNewPlane(plane, row, beside)) return false;
    }
    std::array<std::optional<std::uint16_t>, PixelsAround::kPlaces> masks;
    for (std::size_t place = 0; place < masks.size(); ++place)
      if (const std::size_t n = onPlane(around.pixel[place], plane); n != kNoSample)
        masks[place] = samples_.coverage[n];
    const std::uint16_t mask = coverages_.code(coder_, samples_.coverage[i], masks);
    if constexpr (Coder::kReads) samples_.plane[i] = plane, samples_.coverage[i] = mask;
    return true;
  }

  /// `beside`: a sample whose plane may be like it, or none.
  bool codeNewPlane(std::uint32_t plane, std::size_t row, std::size_t beside) {
    isMet_[plane] = true;
    const auto coded = planeNumbers_.code(
        samples_.planes[plane], Coder::kReads ? PlaneReach{} : reaches_[plane], shape_.camera, direction_,
        tangent_[row], beside == kNoSample ? nullptr : &samples_.planes[samples_.plane[beside]]);
    if (!coded) return false;
    if constexpr (Coder::kReads) samples_.planes[plane] = *coded;
    return true;
  }

  Coder& coder_;
  Samples& samples_;
  const SampleShape& shape_;
  DistanceModel<Coder> distances_;
  std::array<std::array<LikeNeighbours<Coder, 8>, 3>, 2> roles_;
  LikeNeighbours<Coder, 8> mirrors_;
  LikeNeighbours<Coder, 16> alphas_;
  PlaneModel<Coder> planes_;
  PlaneNumberModel<Coder> planeNumbers_;
  std::vector<PlaneReach> reaches_;  ///< by plane; of writing alone
  std::vector<bool> isMet_;          ///< by plane
  CoverageModel<Coder> coverages_;
  DistanceNumbers numbers_;
  std::vector<double> tangent_;              ///< of rows, where planes are asked
  glm::dvec2 direction_{0};                  ///< of the column
  std::vector<std::uint32_t> now_, before_;  ///< where pixels begin
};

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
  CountModel counts(writer, shape.camera.rows);
  std::size_t left = shape.samples;
  for (std::size_t column = 0; column < std::size_t(shape.camera.columns); ++column) {
    counts.beginColumn();
    std::uint32_t at = samples.columnStart[column];
    const std::uint32_t end = samples.columnStart[column + 1];
    for (int row = 0; row < shape.camera.rows; ++row) {
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
  out.columnStart.reserve(std::size_t(shape.camera.columns) + 1);
  CountModel counts(reader, shape.camera.rows);
  std::size_t left = shape.samples;
  for (int column = 0; column < shape.camera.columns; ++column) {
    counts.beginColumn();
    for (int row = 0; row < shape.camera.rows; ++row) {
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
