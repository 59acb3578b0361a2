#pragma once
/// The vector types that kernels are templates over: one lane, on any processor.
///
/// Each of these headers is included only by sources compiled for its processors, and its types are of each
/// such source alone: an inline function that two of them shared could be the one copy that the linker keeps.
/// So those of vectors stay free of the standard library and of glm too.
///
/// All lane types give the same bits: min and max choose as the processor's vector instructions do (the
/// second operand where either is not a number), and nothing is fused.

#include <cstddef>
#include <cstdint>

#include "engine/image/capture.h"

namespace acentric {
namespace {

struct OneLane {
  static constexpr int kWidth = 1;
  using F = float;
  using D = double;
  using I = std::int32_t;
  using M = bool;
  static F set(float value) { return value; }
  static D setd(double value) { return value; }
  static I seti(std::int32_t value) { return value; }
  static I counted(std::int32_t first) { return first; }  ///< first, first + 1, ...
  static F load(const float* p) { return *p; }
  /// The first `count` lanes, the others 0; at least one.
  static F load(const float* p, int) { return *p; }
  static I load(const std::uint32_t* p, int) { return static_cast<I>(*p); }
  static I load(const std::uint16_t* p, int) { return *p; }
  /// The first `count` lanes; at least one.
  static void store(float* p, F a, int) { *p = a; }
  static void store(std::uint32_t* p, I a, int) { *p = static_cast<std::uint32_t>(a); }

  static M less(F a, F b) { return a < b; }
  static M notLess(F a, F b) { return a >= b; }
  static M less(D a, D b) { return a < b; }
  static M notLess(D a, D b) { return a >= b; }
  static M greater(I a, I b) { return a > b; }
  static bool any(M m) { return m; }
  static unsigned bits(M m) { return m; }
  static F select(M m, F a, F b) { return m ? a : b; }
  static I select(M m, I a, I b) { return m ? a : b; }
  static I when(M m, I a) { return m ? a : 0; }

  static F abs(F a) { return __builtin_fabsf(a); }
  static F sqrt(F a) { return __builtin_sqrtf(a); }
  static F min(F a, F b) { return a < b ? a : b; }
  static F max(F a, F b) { return a > b ? a : b; }
  static I times(I a, I b) { return a * b; }
  static I mini(I a, I b) { return a < b ? a : b; }
  static I maxi(I a, I b) { return a > b ? a : b; }
  template <int kBits>
  static I shiftRight(I a) {
    return static_cast<I>(static_cast<std::uint32_t>(a) >> kBits);
  }
  template <int kBits>
  static I shiftLeft(I a) {
    return static_cast<I>(static_cast<std::uint32_t>(a) << kBits);
  }
  static I both(I a, I b) { return a & b; }       ///< bits
  static I different(I a, I b) { return a ^ b; }  ///< bits
  static I asInts(F bits) { return __builtin_bit_cast(I, bits); }

  static F asFloat(I bits) { return __builtin_bit_cast(F, bits); }
  static F toFloat(I a) { return static_cast<float>(a); }
  static F toFloat(D a) { return static_cast<float>(a); }
  static D toDouble(I a) { return a; }
  /// Towards zero; of numbers that an integer holds.
  static I truncate(F a) { return static_cast<I>(a); }
  /// The largest whole number not above a finite one.
  static F floorOf(F a) { return __builtin_floorf(a); }
  /// Of the lower sixteen bits; finite halves.
  static F fromHalf(I half) { return floatFromHalf(static_cast<std::uint16_t>(half)); }

  static I gather(const std::uint32_t* table, I index) { return static_cast<I>(table[index]); }
  static F gather(const float* table, I index) { return table[index]; }
  /// Of a table of 256.
  static F lookUp256(const float* table, I index) { return gather(table, index); }
  /// Of a table of bytes with three more behind it.
  static I gather(const std::uint8_t* table, I index) { return table[index]; }
  /// Words 2 * index and 2 * index + 1.
  static void gatherPairs(const std::uint32_t* table, I index, I& first, I& second) {
    first = static_cast<I>(table[2 * std::ptrdiff_t(index)]);
    second = static_cast<I>(table[2 * std::ptrdiff_t(index) + 1]);
  }

  /// Words of 64 bits, as their low and high halves; the first `count` lanes as above.
  static void loadPairs(const std::uint64_t* p, int, I& low, I& high) {
    low = static_cast<I>(static_cast<std::uint32_t>(*p)), high = static_cast<I>(*p >> 32);
  }
  static void storePairs(std::uint64_t* p, I low, I high, int) {
    *p = static_cast<std::uint32_t>(low) | std::uint64_t(static_cast<std::uint32_t>(high)) << 32;
  }
};

}  // namespace
}  // namespace acentric
