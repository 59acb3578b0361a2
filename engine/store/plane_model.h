#pragma once
/// Which plane each sample lies on, and each plane where it is met first (FORMAT.md, "Range-coded streams").

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/image/plane_numbers.h"
#include "engine/store/difference_model.h"
#include "engine/store/pixels_around.h"

namespace acentric {

/// Mostly the plane of the sample before in the same pixel, or one of those in the pixels around, or one that
/// is met for the first time; planes are mostly numbered in that order.
template <class Coder>
class PlaneModel {
 public:
  PlaneModel(Coder& coder, std::size_t planes)
      : coder_(coder), bits_(planes > 1 ? int(std::bit_width(planes - 1)) : 1) {}

  /// `planes` holds those of the samples before this one; `own` are these of its pixel, which has `count` in
  /// all.
  template <class Planes>
  std::uint32_t code(std::uint32_t value, const Planes& planes, const PixelsAround& around,
                     const PixelRange& own, std::uint32_t count) {
    if (own.first < own.end) {
      const std::uint32_t last = planes[own.end - 1];
      if (coder_.bit(again_[againAround(planes, around, own)], value == last)) return last;
    }
    listCandidates(planes, around, own);
    auto& isIt = isIt_[alikeAround(around, own, count)];
    for (std::size_t k = 0; k < count_; ++k)
      if (coder_.bit(isIt[std::min(k, kRanks - 1)][where_[k]], value == candidate_[k])) return candidate_[k];
    if (coder_.bit(isNext_[std::min<std::size_t>(count_, 1)], value == next_)) return next_++;
    if (coder_.bit(isMet_, value < next_)) return next_ - 1 - codeBack(next_ - 1 - value);
    return coder_.plain(value, bits_);
  }

 private:
  static constexpr std::size_t kMost = 16, kRanks = 4, kDigits = 5;
  static constexpr std::uint32_t kLayers = 12;

  /// Whether samples of the pixel, and those at the same place in two others, share the plane of the one
  /// before them: glass that looks different to each region does.
  template <class Planes>
  std::size_t againAround(const Planes& planes, const PixelsAround& around, const PixelRange& own) const {
    const std::uint32_t layer = own.end - own.first;
    const auto again = [&](PixelsAround::Place place) -> std::size_t {
      const std::uint32_t at = around.pixel[place].first + layer;
      return at >= around.pixel[place].end ? 0 : planes[at] == planes[at - 1] ? 2 : 1;
    };
    const bool repeats = layer > 1 && planes[own.end - 1] == planes[own.end - 2];
    return 9 * std::size_t(repeats) + 3 * again(PixelsAround::kAbove) + again(PixelsAround::kBefore);
  }

  /// Pixels that hold as many samples as those beside them mostly hold the same planes.
  static std::size_t alikeAround(const PixelsAround& around, const PixelRange& own, std::uint32_t count) {
    const auto isAsFull = [&](PixelsAround::Place place) {
      return std::size_t(around.pixel[place].end - around.pixel[place].first == count);
    };
    return isAsFull(PixelsAround::kBefore) | isAsFull(PixelsAround::kAbove) << 1 |
           std::size_t(own.first < own.end) << 2;
  }

  /// Nearest surfaces first; not those that the pixel has already.
  template <class Planes>
  void listCandidates(const Planes& planes, const PixelsAround& around, const PixelRange& own) {
    count_ = 0;
    for (std::uint32_t layer = 0; layer < kLayers; ++layer) {
      bool any = false;
      for (std::size_t place = 0; place < PixelsAround::kPlaces; ++place) {
        const PixelRange& pixel = around.pixel[place];
        if (pixel.first + layer >= pixel.end) continue;
        any = true;
        add(planes[pixel.first + layer], std::uint8_t(1u << place), planes, own);
      }
      if (!any) break;
    }
  }
  template <class Planes>
  void add(std::uint32_t plane, std::uint8_t place, const Planes& planes, const PixelRange& own) {
    for (std::size_t k = 0; k < count_; ++k)
      if (candidate_[k] == plane) {
        where_[k] |= place;
        return;
      }
    for (std::uint32_t i = own.first; i < own.end; ++i)
      if (planes[i] == plane) return;
    if (count_ == kMost) return;
    candidate_[count_] = plane, where_[count_] = place;
    ++count_;
  }

  /// By how many planes were met since.
  std::uint32_t codeBack(std::uint32_t back) {
    const std::uint32_t digits = digits_.code(coder_, std::uint32_t(std::bit_width(back)));
    if (digits < 2) return digits;
    const int rest = int(digits) - 2;
    const auto second = std::uint32_t(coder_.bit(second_[digits], (back >> rest & 1u) != 0));
    return (2 | second) << rest | coder_.plain(back & ((1u << rest) - 1), rest);
  }

  Coder& coder_;
  int bits_;
  std::array<std::uint32_t, kMost> candidate_{};
  std::array<std::uint8_t, kMost> where_{};  ///< in which of the pixels around, by bits
  std::size_t count_ = 0;
  std::uint32_t next_ = 0;
  std::array<std::array<std::array<BitChance, 1u << PixelsAround::kPlaces>, kRanks>, 8> isIt_;
  std::array<BitChance, 2> isNext_;
  BitChance isMet_;
  std::array<BitChance, 18> again_;
  BitTree<kDigits> digits_;
  std::array<BitChance, 1u << kDigits> second_;
};

/// The numbers of planes (image/plane_numbers.h), by those of a plane beside them; of planes that have none
/// their floats.
template <class Coder>
class PlaneNumberModel {
 public:
  /// `step` 0: floats alone.
  PlaneNumberModel(Coder& coder, double step) : coder_(coder), step_(step) {}

  /// Of a plane that is met first at the ray; `reach` for writing alone, `beside`: the plane of a sample
  /// there, or null. Nothing if what is read is no plane.
  std::optional<SurfacePlane> code(const SurfacePlane& plane, const PlaneReach& reach,
                                   const ColumnCamera& camera, const glm::dvec2& direction, double tangent,
                                   const SurfacePlane* beside) {
    const bool away = coder_.bit(away_, plane.away != 0);
    const PlaneFrame frame(direction, tangent, step_ > 0 ? step_ : 1);
    PlaneScale scale;
    std::optional<PlaneNumbers> numbers;
    if constexpr (!Coder::kReads) {
      scale = reach.scale(camera);
      if (step_ > 0) numbers = frame.exactNumbersOf(plane, scale);
    }
    SurfacePlane out;
    if (coder_.bit(hasNumbers_, numbers.has_value())) {
      scale = {int(across_.code(coder_, std::uint32_t(scale.across))),
               int(down_.code(coder_, std::uint32_t(scale.down)))};
      PlaneNumbers expected;
      if (beside != nullptr) expected = frame.numbersOf(*beside, scale).value_or(PlaneNumbers{});
      const PlaneNumbers own = numbers.value_or(PlaneNumbers{});
      const auto codeOne = [&](auto& model, std::int64_t value, std::int64_t like, int leftOut) {
        return like + model.code(coder_, value - like, std::size_t(leftOut));
      };
      out = frame.planeAt({codeOne(ahead_, own.inverseDistance, expected.inverseDistance, 0),
                           codeOne(sideways_, own.across, expected.across, scale.across),
                           codeOne(upwards_, own.down, expected.down, scale.down)},
                          scale);
    } else {
      for (int k = 0; k < 3; ++k)
        out.normal[k] = std::bit_cast<float>(coder_.plain(std::bit_cast<std::uint32_t>(plane.normal[k]), 32));
    }
    out.away = away ? 1 : 0;
    if (!std::isfinite(out.normal.x) || !std::isfinite(out.normal.y) || !std::isfinite(out.normal.z))
      return {};
    return out;
  }

 private:
  static constexpr std::size_t kScaleBits = 4;
  static_assert(kMostLeftOut < 1 << kScaleBits);

  Coder& coder_;
  double step_;
  BitChance away_, hasNumbers_;
  BitTree<kScaleBits> across_, down_;
  DifferenceModel<1> ahead_;
  DifferenceModel<kMostLeftOut + 1> sideways_, upwards_;
};

}  // namespace acentric
