#pragma once
/// Arrays of small numbers turned into byte planes that compress well and unpack fast: each number is
/// replaced by its difference from the one before (modulo its width), then all lowest bytes are stored, then
/// all second bytes, and so on. Neighbouring samples differ little, so the upper planes are nearly all zero.

#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

namespace acentric {

/// One field of `width` bytes (1, 2 or 4) in each of a series of records that lie `stride` bytes apart.
template <class Byte>
struct BasicLane {
  Byte* first = nullptr;  ///< the field of record 0
  std::size_t stride = 0;
  int width = 0;
};
using Lane = BasicLane<std::byte>;
using ConstLane = BasicLane<const std::byte>;

/// The lane of all elements of a vector of plain numbers; of one half of a colour with `offset` and `width`.
template <class T>
Lane laneOf(std::vector<T>& values, std::size_t offset = 0, int width = sizeof(T)) {
  if (values.empty()) return {nullptr, sizeof(T), width};
  return {reinterpret_cast<std::byte*>(values.data()) + offset, sizeof(T), width};
}
template <class T>
ConstLane laneOf(const std::vector<T>& values, std::size_t offset = 0, int width = sizeof(T)) {
  if (values.empty()) return {nullptr, sizeof(T), width};
  return {reinterpret_cast<const std::byte*>(values.data()) + offset, sizeof(T), width};
}

/// Bytes of one record over all lanes.
template <class Byte>
std::size_t recordBytes(std::span<const BasicLane<Byte>> lanes) {
  std::size_t bytes = 0;
  for (const BasicLane<Byte>& lane : lanes) bytes += static_cast<std::size_t>(lane.width);
  return bytes;
}

/// Records [begin, begin + count) to recordBytes * count bytes: lane after lane, within a lane plane after
/// plane.
void encodeLanes(std::span<const ConstLane> lanes, std::size_t begin, std::size_t count, std::byte* planes);
void decodeLanes(std::span<const Lane> lanes, std::size_t begin, std::size_t count, const std::byte* planes);

}  // namespace acentric
