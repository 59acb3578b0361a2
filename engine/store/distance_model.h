#pragma once
/// Inverse distances as whole numbers, foretold by the planes of samples, or from samples around them. On a
/// plane the difference between a column and the one before is the same in all rows (the inverse distance is
/// linear in the column's direction and in the row's tangent), so a sample is foretold by the one before it,
/// whose rounding is smoothed away, and what the samples above were off by. Where there is none before, by
/// the samples above. All in whole numbers: every machine reads the same.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/store/difference_model.h"
#include "engine/store/pixels_around.h"

namespace acentric {

/// Inverse distances reach this many steps at most.
inline constexpr std::uint64_t kMostDistanceNumbers = std::uint64_t(1) << 40;

/// The number of an inverse distance among those that can be stored: multiples of the step up to 2^16, from
/// there on 2^15 in each octave. Without a step, the float's bits without the last 8.
class DistanceNumbers {
 public:
  explicit DistanceNumbers(double step) : step_(step), perStep_(step > 0 ? 1 / step : 0) {}

  std::int64_t numberOf(float w) const {
    if (!(step_ > 0)) return std::int64_t(std::bit_cast<std::uint32_t>(w) >> 8);
    const double exact = double(w) * perStep_;
    // More of them than a capture may have: what a plane of a damaged file leads to.
    const auto steps = exact < double(kMostDistanceNumbers) ? std::uint64_t(exact) : kMostDistanceNumbers;
    if (steps < 0x10000) return std::int64_t(steps);
    const int octave = int(std::bit_width(steps)) - 16;
    return std::int64_t(steps >> octave) + (std::int64_t(octave) << 15);
  }
  /// Nothing for what numberOf never gives.
  std::optional<float> at(std::int64_t number) const {
    if (number < 0) return std::nullopt;
    if (!(step_ > 0)) {
      if (number > 0x7fffff) return std::nullopt;
      return std::bit_cast<float>(std::uint32_t(number) << 8);
    }
    if (number < 0x10000) return float(double(number) * step_);
    const std::int64_t octave = (number >> 15) - 1;
    if (octave > 26) return std::nullopt;
    const std::uint64_t steps = (std::uint64_t(number & 0x7fff) | 0x8000u) << octave;
    return float(double(steps) * step_);
  }

 private:
  double step_, perStep_;
};

template <class Coder>
class DistanceModel {
 public:
  DistanceModel(Coder& coder, double step) : coder_(coder), numbers_(step) {}

  void beginColumn(std::size_t first, std::size_t count) {
    std::swap(before_, now_);
    beforeFirst_ = nowFirst_;
    nowFirst_ = first;
    now_.assign(count, {});
  }

  /// Of sample `i`; kNoSample for neighbours that are not there. Nothing if what is read is no distance.
  std::optional<float> code(float w, std::size_t i, std::size_t above, std::size_t before,
                            std::size_t inFront) {
    const Trace* n = above == kNoSample ? nullptr : &now_[above - nowFirst_];
    const Trace* b = before == kNoSample ? nullptr : &before_[before - beforeFirst_];
    Trace own;
    // Three ways to foretell it: by the one before and what that one, or the one above, was apart from its
    // own one before; and by the one above.
    const std::array<std::int64_t, kWays> ways = {b ? b->smooth + b->drift : 0,
                                                  b ? b->smooth + (n ? n->drift : b->drift) : 0,
                                                  n ? (n->number << kFraction) + n->slope : 0};
    std::size_t way = b ? 0 : 2;
    if (b && n) {
      const auto offOf = [&](std::size_t k) { return n->offWay[k] + b->offWay[k]; };
      for (const std::size_t other : {1u, 2u})
        if (offOf(other) < offOf(way)) way = other;
    }
    std::int64_t foretold = ways[way];
    if (!n && !b) foretold = (inFront == kNoSample ? last_ : now_[inFront - nowFirst_].number) << kFraction;

    const std::int64_t nearest = (foretold + kHalf) >> kFraction;
    const auto rest = std::size_t((foretold + kHalf - (nearest << kFraction)) >> (kFraction - 4));  // 0..15
    const std::uint32_t unrest = (n ? n->off : b ? b->off : 8u) + (b ? b->off : n ? n->off : 8u);
    const std::int64_t off = differences_.code(coder_, numbers_.numberOf(w) - nearest, classOf(unrest), rest);
    own.number = nearest + off;
    const auto value = numbers_.at(own.number);
    if (!value) return std::nullopt;

    const std::int64_t exact = own.number << kFraction;
    own.off = std::uint32_t(std::min<std::int64_t>(std::abs(off), 255));
    for (std::size_t k = 0; k < kWays; ++k)
      own.offWay[k] = (k < 2 ? b != nullptr : n != nullptr) ? apart(exact, ways[k]) : kFar;
    own.smooth = exact;
    if (b) {
      const std::size_t nearer = own.offWay[1] < own.offWay[0] ? 1 : 0;
      const std::int64_t error = exact - ways[nearer];
      const bool smooth = own.offWay[nearer] < kSmooth;
      if (smooth) own.smooth = ways[nearer] + error / kSmoothing;
      own.drift = smooth ? ways[nearer] - b->smooth + error / kDrifting : exact - b->smooth;
    }
    if (n) {
      const std::int64_t step = exact - (n->number << kFraction);
      own.slope = own.offWay[2] < kSmooth ? n->slope + (step - n->slope) / kSloping : step;
    }
    last_ = own.number;
    now_[i - nowFirst_] = own;
    return value;
  }

  /// The same where the sample's plane tells `foretold`. What is coded is by how much it differs, and depends
  /// on no number: another machine's rounding of a plane shifts one sample by a step.
  std::optional<float> codeBeside(std::int64_t foretold, float w, std::size_t i, std::size_t above,
                                  std::size_t before) {
    const std::uint32_t offAbove = above == kNoSample ? 0 : now_[above - nowFirst_].off,
                        offBefore = before == kNoSample ? 0 : before_[before - beforeFirst_].off;
    Trace own;
    const std::int64_t off =
        differences_.code(coder_, numbers_.numberOf(w) - foretold, classOf(offAbove + offBefore));
    own.number = foretold + off;
    own.off = std::uint32_t(std::min<std::int64_t>(std::abs(off), 255));
    now_[i - nowFirst_] = own;
    return numbers_.at(own.number);
  }

 private:
  static constexpr int kFraction = 8;
  static constexpr std::int64_t kHalf = std::int64_t(1) << (kFraction - 1);
  static constexpr std::size_t kWays = 3;
  static constexpr std::int64_t kSmoothing = 2, kDrifting = 4, kSloping = 4;
  static constexpr std::uint32_t kSmooth = 4u << kFraction, kFar = 64u << kFraction;

  /// What is kept of a sample for those beside and below it; in parts of 1/256 where not said otherwise.
  struct Trace {
    std::int64_t number = 0;  ///< whole
    std::int64_t smooth = 0;  ///< the same, less rounded
    std::int64_t drift = 0;   ///< from the column before
    std::int64_t slope = 0;   ///< from the row above
    std::array<std::uint32_t, kWays> offWay = {kFar, kFar, kFar};
    std::uint32_t off = 8;  ///< whole
  };

  static std::uint32_t apart(std::int64_t a, std::int64_t b) {
    return std::uint32_t(std::min<std::int64_t>(std::abs(a - b), kFar));
  }
  static std::size_t classOf(std::uint32_t unrest) {
    return unrest < 3 ? unrest : std::min<std::size_t>(std::size_t(std::bit_width(unrest)) + 1, 9);
  }

  Coder& coder_;
  DistanceNumbers numbers_;
  DifferenceModel<10, 16> differences_;
  std::vector<Trace> now_, before_;
  std::size_t nowFirst_ = 0, beforeFirst_ = 0;
  std::int64_t last_ = 0;
};

}  // namespace acentric
