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

/// Sizes of the arrays and column offsets. `noun`: what its samples are.
Status checkArrays(const CaptureSamples& s, std::size_t columns, bool mirrors, const char* noun) {
  if (s.columnStart.size() != columns + 1)
    return malformed(
        fmt::format("has {} column offsets of {}s, needs {}", s.columnStart.size(), noun, columns + 1));
  if (s.row.size() > kMaxCaptureSamples)
    return fail(ErrorKind::tooLarge, fmt::format("has {} {}s, the limit is 2^31", s.row.size(), noun),
                "capture");
  if (s.inverseDistance.size() != s.row.size() || s.colour.size() != s.row.size() ||
      s.roles.size() != s.row.size())
    return malformed(
        fmt::format("{}s have {} rows, {} distances, {} colours and {} roles: they must be equally many",
                    noun, s.row.size(), s.inverseDistance.size(), s.colour.size(), s.roles.size()));
  if (s.mirror.size() != (mirrors ? s.row.size() : 0))
    return malformed(
        fmt::format("{}s name {} mirrors, {} are needed", noun, s.mirror.size(), mirrors ? s.row.size() : 0));
  if (s.columnStart.front() != 0 || s.columnStart.back() != s.row.size())
    return malformed(fmt::format("column offsets do not span the {}s", noun));
  if (!std::is_sorted(s.columnStart.begin(), s.columnStart.end()))
    return malformed(fmt::format("column offsets of {}s do not rise", noun));
  return {};
}

Status checkSamples(const CaptureSamples& s, const ColumnCamera& camera, bool reflections, const char* noun) {
  for (std::size_t column = 0; column + 1 < s.columnStart.size(); ++column) {
    const std::size_t first = s.columnStart[column];
    for (std::size_t i = first; i < s.columnStart[column + 1]; ++i) {
      const auto bad = [&](const char* what) {
        return malformed(fmt::format("{} {} (column {}): {}", noun, i, column, what));
      };
      if (s.row[i] >= camera.rows) return bad("row lies below the image");
      if (!(s.inverseDistance[i] >= 0) || !std::isfinite(s.inverseDistance[i]))
        return bad("inverse distance is not a finite number >= 0");
      if ((std::bit_cast<std::uint32_t>(s.inverseDistance[i]) & 0xffu) != 0)
        return bad("inverse distance has more than 16 significant bits");
      if (s.roles[i] == 0) return bad("no role needs it");
      if (!isStorable(s.colour[i])) return bad("radiance must be finite and >= 0, alpha within [0,1]");
      if (!s.mirror.empty() && s.mirror[i] != 0 && s.colour[i].a != kHalfOne)
        return bad("mirrors and what they show must be opaque");
      if (reflections && s.mirror[i] == 0) return bad("no mirror shows it");
      if (i == first) continue;
      if (s.row[i] < s.row[i - 1]) return bad("rows are not sorted");
      if (s.row[i] == s.row[i - 1] && s.inverseDistance[i] > s.inverseDistance[i - 1])
        return bad("layers of a pixel are not sorted nearest first");
    }
  }
  return {};
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
  // A power of two times 2^52 is no less exact as a summand than as a divisor, and faster.
  const double shift = kRound * coarser;
  const double stored = inverseDistance + shift - shift;
  return float(std::max(stored, step));
}

int CaptureSamples::maxLayers() const {
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
  if (!(distanceStep >= 0) || !std::isfinite(distanceStep))
    return malformed("the step of its distances is not a finite number >= 0");
  const auto columns = static_cast<std::size_t>(camera.columns);
  if (auto sound = checkArrays(*this, columns, hasReflections(), "sample"); !sound) return sound;
  if (auto sound = checkSamples(*this, camera, false, "sample"); !sound) return sound;
  if (reflections == CaptureSamples{}) return {};
  if (!hasReflections()) return malformed("its list of reflections is there, and empty");
  if (auto sound = checkArrays(reflections, columns, true, "reflection"); !sound) return sound;
  return checkSamples(reflections, camera, true, "reflection");
}

}  // namespace acentric
