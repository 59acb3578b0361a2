#include "engine/store/lanes.h"

#include <bit>
#include <cstdint>
#include <cstring>

#include "engine/base/contract.h"

namespace acentric {
namespace {

static_assert(std::endian::native == std::endian::little, "records are copied as they lie in memory");

template <class Word>
void encodeLane(const std::byte* in, std::size_t stride, std::size_t count, std::byte* planes) {
  Word previous = 0;
  for (std::size_t i = 0; i < count; ++i, in += stride) {
    Word value;
    std::memcpy(&value, in, sizeof value);
    const Word difference = static_cast<Word>(value - previous);
    previous = value;
    for (std::size_t plane = 0; plane < sizeof(Word); ++plane)
      planes[plane * count + i] = static_cast<std::byte>(difference >> (8 * plane));
  }
}

template <class Word>
void decodeLane(const std::byte* planes, std::size_t stride, std::size_t count, std::byte* out) {
  Word value = 0;
  for (std::size_t i = 0; i < count; ++i, out += stride) {
    std::uint32_t difference = 0;
    for (std::size_t plane = 0; plane < sizeof(Word); ++plane)
      difference |= std::to_integer<std::uint32_t>(planes[plane * count + i]) << (8 * plane);
    value = static_cast<Word>(value + difference);
    std::memcpy(out, &value, sizeof value);
  }
}

}  // namespace

void encodeLanes(std::span<const ConstLane> lanes, std::size_t begin, std::size_t count, std::byte* planes) {
  for (const ConstLane& lane : lanes) {
    require(lane.width == 1 || lane.width == 2 || lane.width == 4, "lanes are 1, 2 or 4 bytes wide");
    const std::byte* in = lane.first + begin * lane.stride;
    if (lane.width == 1) encodeLane<std::uint8_t>(in, lane.stride, count, planes);
    if (lane.width == 2) encodeLane<std::uint16_t>(in, lane.stride, count, planes);
    if (lane.width == 4) encodeLane<std::uint32_t>(in, lane.stride, count, planes);
    planes += static_cast<std::size_t>(lane.width) * count;
  }
}

void decodeLanes(std::span<const Lane> lanes, std::size_t begin, std::size_t count, const std::byte* planes) {
  for (const Lane& lane : lanes) {
    require(lane.width == 1 || lane.width == 2 || lane.width == 4, "lanes are 1, 2 or 4 bytes wide");
    std::byte* out = lane.first + begin * lane.stride;
    if (lane.width == 1) decodeLane<std::uint8_t>(planes, lane.stride, count, out);
    if (lane.width == 2) decodeLane<std::uint16_t>(planes, lane.stride, count, out);
    if (lane.width == 4) decodeLane<std::uint32_t>(planes, lane.stride, count, out);
    planes += static_cast<std::size_t>(lane.width) * count;
  }
}

}  // namespace acentric
