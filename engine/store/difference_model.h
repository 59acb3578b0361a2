#pragma once
/// Differences from what was foretold as a range-coded stream: whether there is one, its sign, how many
/// binary digits it has, the digits. All but the later digits by `unrest`, a class of how far off its
/// neighbours were; the first two also by `rest`, a class of what was foretold.

#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>

#include "engine/store/range_coder.h"

namespace acentric {

template <std::size_t kUnrests, std::size_t kRests = 1>
class DifferenceModel {
 public:
  template <class Coder>
  std::int64_t code(Coder& coder, std::int64_t off, std::size_t unrest, std::size_t rest = 0) {
    if (!coder.bit(differs_[unrest][rest], off != 0)) return 0;
    const bool less = coder.bit(less_[unrest][rest], off < 0);
    const std::uint64_t size = std::uint64_t(std::abs(off));  // from 1
    int digits = 1;
    const int wanted = Coder::kReads ? 0 : int(std::bit_width(size));
    while (digits < kMostDigits && coder.bit(longer_[unrest][std::size_t(digits)], wanted > digits)) ++digits;
    std::uint64_t out = 1;
    for (int d = digits - 2; d >= 0; --d) {
      const bool one = (size >> d & 1u) != 0;
      const bool known = d == digits - 2;
      const std::uint32_t b = known ? std::uint32_t(coder.bit(second_[std::size_t(digits)], one))
                                    : coder.plain(std::uint32_t(one), 1);
      out = out << 1 | b;
    }
    return less ? -std::int64_t(out) : std::int64_t(out);
  }

 private:
  static constexpr int kMostDigits = 26;
  std::array<std::array<BitChance, kRests>, kUnrests> differs_, less_;
  std::array<std::array<BitChance, kMostDigits + 1>, kUnrests> longer_;
  std::array<BitChance, kMostDigits + 1> second_;
};

}  // namespace acentric
