#include "engine/image/capture.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/packing.hpp>

namespace acentric {
namespace {

constexpr float kLargestHalf = 65504.0f;
constexpr std::uint16_t kHalfInfinity = 0x7c00;
constexpr std::uint16_t kHalfOne = 0x3c00;

std::uint16_t packRadiance(float value) {
  // The comparison is false for NaN. Anything that would round past the largest half is clamped before
  // packing.
  return value > 0 ? glm::packHalf1x16(std::min(value, kLargestHalf)) : std::uint16_t(0);
}

/// Non-negative halves are ordered as their codes; negative ones and NaN lie above infinity.
bool isStorable(const HalfColour& colour) {
  return colour.r < kHalfInfinity && colour.g < kHalfInfinity && colour.b < kHalfInfinity &&
         colour.a <= kHalfOne;
}

tl::unexpected<Error> malformed(std::string message) {
  return fail(ErrorKind::malformed, std::move(message), "capture");
}

}  // namespace

HalfColour packColour(const glm::vec4& linearRgba) {
  return HalfColour(packRadiance(linearRgba.r), packRadiance(linearRgba.g), packRadiance(linearRgba.b),
                    linearRgba.a >= 1 ? kHalfOne : packRadiance(linearRgba.a));
}

glm::vec4 unpackColour(const HalfColour& colour) {
  return glm::vec4(glm::unpackHalf1x16(colour.r), glm::unpackHalf1x16(colour.g),
                   glm::unpackHalf1x16(colour.b), glm::unpackHalf1x16(colour.a));
}

float storedInverseDistance(double inverseDistance, double step) {
  if (!(inverseDistance > 0)) return 0;
  // The power of two at or below the number, by its exponent's bits.
  constexpr std::uint64_t kExponent = 0x7ff0'0000'0000'0000;
  const double power = std::bit_cast<double>(std::bit_cast<std::uint64_t>(inverseDistance) & kExponent);
  const double own = power * 0x1p-15;     // of 16 significant bits
  constexpr double kSmallest = 0x1p-141;  // of the smallest floats the last 8 bits
  const double coarser = std::max({step, own, kSmallest});
  constexpr double kRound = 0x1.8p52;  // leaves no bit behind the point
  const double stored = (inverseDistance / coarser + kRound - kRound) * coarser;
  return float(std::max(stored, step));
}

int Capture::maxLayers() const {
  int most = 0;
  for (std::size_t column = 0; column + 1 < columnStart.size(); ++column) {
    int layers = 0;
    for (std::size_t i = columnStart[column]; i < columnStart[column + 1]; ++i) {
      const bool samePixel = i > columnStart[column] && row[i] == row[i - 1];
      layers = samePixel ? layers + 1 : 1;
      most = std::max(most, layers);
    }
  }
  return most;
}

Status Capture::check() const {
  if (auto sound = camera.check(); !sound) return sound;
  const std::size_t columns = static_cast<std::size_t>(camera.columns);
  if (columnStart.size() != columns + 1)
    return malformed(fmt::format("has {} column offsets, needs {}", columnStart.size(), columns + 1));
  if (row.size() > kMaxCaptureSamples)
    return fail(ErrorKind::tooLarge, fmt::format("has {} samples, the limit is 2^31", row.size()), "capture");
  if (inverseDistance.size() != row.size() || colour.size() != row.size() || roles.size() != row.size())
    return malformed(
        fmt::format("has {} rows, {} distances, {} colours and {} roles: they must be equally many",
                    row.size(), inverseDistance.size(), colour.size(), roles.size()));
  if (!(distanceStep >= 0) || !std::isfinite(distanceStep))
    return malformed("the step of its distances is not a finite number >= 0");
  if (columnStart.front() != 0 || columnStart.back() != row.size())
    return malformed("column offsets do not span the samples");
  if (!std::is_sorted(columnStart.begin(), columnStart.end())) return malformed("column offsets do not rise");

  for (std::size_t column = 0; column < columns; ++column) {
    const std::size_t first = columnStart[column];
    for (std::size_t i = first; i < columnStart[column + 1]; ++i) {
      const auto bad = [&](const char* what) {
        return malformed(fmt::format("sample {} (column {}): {}", i, column, what));
      };
      if (row[i] >= camera.rows) return bad("row lies below the image");
      if (!(inverseDistance[i] >= 0) || !std::isfinite(inverseDistance[i]))
        return bad("inverse distance is not a finite number >= 0");
      if ((std::bit_cast<std::uint32_t>(inverseDistance[i]) & 0xffu) != 0)
        return bad("inverse distance has more than 16 significant bits");
      if (roles[i] == 0) return bad("no role needs it");
      if (!isStorable(colour[i])) return bad("radiance must be finite and >= 0, alpha within [0,1]");
      if (i == first) continue;
      if (row[i] < row[i - 1]) return bad("rows are not sorted");
      if (row[i] == row[i - 1] && inverseDistance[i] > inverseDistance[i - 1])
        return bad("layers of a pixel are not sorted nearest first");
    }
  }
  return {};
}

}  // namespace acentric
