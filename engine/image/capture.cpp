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

tl::unexpected<Error> malformedCapture(std::string message) {
  return malformed(std::move(message), "capture");
}

/// Sizes of the arrays and column offsets. `noun`: what its samples are.
Status checkArrays(const CaptureSamples& s, std::size_t columns, bool mirrors, const char* noun) {
  if (s.columnStart.size() != columns + 1)
    return malformedCapture(
        fmt::format("has {} column offsets of {}s, needs {}", s.columnStart.size(), noun, columns + 1));
  if (s.row.size() > kMaxCaptureSamples)
    return fail(ErrorKind::tooLarge, fmt::format("has {} {}s, the limit is 2^31", s.row.size(), noun),
                "capture");
  if (s.inverseDistance.size() != s.row.size() || s.colour.size() != s.row.size() ||
      s.roles.size() != s.row.size())
    return malformedCapture(
        fmt::format("{}s have {} rows, {} distances, {} colours and {} roles: they must be equally many",
                    noun, s.row.size(), s.inverseDistance.size(), s.colour.size(), s.roles.size()));
  if (s.mirror.size() != (mirrors ? s.row.size() : 0))
    return malformedCapture(
        fmt::format("{}s name {} mirrors, {} are needed", noun, s.mirror.size(), mirrors ? s.row.size() : 0));
  if (s.coverage.size() != s.plane.size() ||
      (s.plane.empty() ? !s.planes.empty() : s.plane.size() != s.row.size()))
    return malformedCapture(fmt::format("{}s have {} coverages and {} planes of {}: all need them, or none",
                                        noun, s.coverage.size(), s.plane.size(), s.planes.size()));
  for (std::size_t i = 0; i < s.planes.size(); ++i)
    if (const SurfacePlane& plane = s.planes[i];
        !std::isfinite(plane.normal.x + plane.normal.y + plane.normal.z) || plane.away > 1)
      return malformedCapture(fmt::format("plane {} of {}s is not one", i, noun));
  if (s.columnStart.front() != 0 || s.columnStart.back() != s.row.size())
    return malformedCapture(fmt::format("column offsets do not span the {}s", noun));
  if (!std::is_sorted(s.columnStart.begin(), s.columnStart.end()))
    return malformedCapture(fmt::format("column offsets of {}s do not rise", noun));
  return {};
}

Status checkSamples(const CaptureSamples& s, const ColumnCamera& camera, bool reflections, const char* noun) {
  for (std::size_t column = 0; column + 1 < s.columnStart.size(); ++column) {
    const std::size_t first = s.columnStart[column];
    for (std::size_t i = first; i < s.columnStart[column + 1]; ++i) {
      const auto bad = [&](const char* what) {
        return malformedCapture(fmt::format("{} {} (column {}): {}", noun, i, column, what));
      };
      if (s.row[i] >= camera.rows) return bad("row lies below the image");
      if (!(s.inverseDistance[i] >= 0) || !std::isfinite(s.inverseDistance[i]))
        return bad("inverse distance is not a finite number >= 0");
      if (!reflections && s.inverseDistance[i] == 0) return bad("is infinitely far: that is the background");
      if ((std::bit_cast<std::uint32_t>(s.inverseDistance[i]) & 0xffu) != 0)
        return bad("inverse distance has more than 16 significant bits");
      if (s.roles[i] == 0) return bad("no role needs it");
      if (!isStorable(s.colour[i])) return bad("radiance must be finite and >= 0, alpha within [0,1]");
      const bool mustBeOpaque =
          reflections ? s.inverseDistance[i] == 0 : !s.mirror.empty() && s.mirror[i] != 0;
      if (mustBeOpaque && s.colour[i].a != kHalfOne) return bad("mirrors and the sky must be opaque");
      if (reflections && s.mirror[i] == 0) return bad("no mirror shows it");
      if (s.hasSilhouettes() && s.coverage[i] == 0) return bad("covers nothing of its pixel");
      if (s.hasSilhouettes() && s.plane[i] >= s.planes.size()) return bad("lies on no plane of the capture");
      if (i == first) continue;
      if (s.row[i] < s.row[i - 1]) return bad("rows are not sorted");
      if (s.row[i] == s.row[i - 1] && s.inverseDistance[i] > s.inverseDistance[i - 1])
        return bad("layers of a pixel are not sorted nearest first");
    }
  }
  return {};
}

Status checkBackground(const CaptureBackground& b, const ColumnCamera& camera) {
  if (b == CaptureBackground{}) return {};
  const auto columns = static_cast<std::size_t>(camera.columns);
  if (b.runCount() == 0)
    return malformedCapture("its background has no rows, and yet colours or column offsets");
  for (const glm::vec3& radiance : {b.sky.zenith, b.sky.horizon, b.sky.ground})
    for (int i = 0; i < 3; ++i)
      if (!(radiance[i] >= 0) || !std::isfinite(radiance[i]))
        return malformedCapture("radiance of its background is not a finite number >= 0");
  if (b.endRow.size() != b.runCount() || b.roles.size() != b.runCount())
    return malformedCapture(
        fmt::format("its background has {} first rows, {} ends and {} roles: they must be equally many",
                    b.runCount(), b.endRow.size(), b.roles.size()));
  if (b.columnStart.size() != columns + 1 || b.columnStart.front() != 0 ||
      b.columnStart.back() != b.runCount() || !std::is_sorted(b.columnStart.begin(), b.columnStart.end()))
    return malformedCapture("column offsets of its background do not partition the runs of rows");
  for (std::size_t column = 0; column < columns; ++column) {
    const std::size_t first = b.columnStart[column];
    for (std::size_t i = first; i < b.columnStart[column + 1]; ++i) {
      const auto bad = [&](const char* what) {
        return malformedCapture(fmt::format("run {} of its background (column {}): {}", i, column, what));
      };
      if (b.firstRow[i] >= b.endRow[i] || b.endRow[i] > camera.rows) return bad("no rows of the image");
      if (b.roles[i] == 0) return bad("no role needs it");
      if (i == first) continue;
      if (b.firstRow[i] < b.endRow[i - 1]) return bad("does not lie below the one before");
      if (b.firstRow[i] == b.endRow[i - 1] && b.roles[i] == b.roles[i - 1])
        return bad("goes on with the one before");
    }
  }
  return {};
}

}  // namespace

HalfColour packColour(const glm::vec4& linearRgba) {
  return HalfColour(packRadiance(linearRgba.r), packRadiance(linearRgba.g), packRadiance(linearRgba.b),
                    linearRgba.a >= 1 ? kHalfOne : packRadiance(linearRgba.a));
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

std::size_t CaptureSamples::bytes() const {
  return columnStart.size() * sizeof columnStart[0] + sampleCount() * kCaptureSampleBytes + mirror.size() +
         coverage.size() * sizeof coverage[0] + plane.size() * sizeof plane[0] +
         planes.size() * sizeof planes[0];
}

std::size_t CaptureBackground::pixelCount() const {
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < runCount(); ++i) pixels += std::size_t(endRow[i] - firstRow[i]);
  return pixels;
}

std::size_t CaptureBackground::bytes() const {
  return columnStart.size() * sizeof columnStart[0] +
         runCount() * (sizeof firstRow[0] + sizeof endRow[0] + sizeof roles[0]);
}

void BackgroundBuilder::add(int row, std::uint8_t roles) {
  const std::size_t first = runs_.columnStart.empty() ? 0 : runs_.columnStart.back();
  const bool goesOn = runs_.runCount() > first && runs_.endRow.back() == row && runs_.roles.back() == roles;
  if (!goesOn) {
    runs_.firstRow.push_back(std::uint16_t(row));
    runs_.endRow.push_back(0);
    runs_.roles.push_back(roles);
  }
  runs_.endRow.back() = std::uint16_t(row + 1);
}

void BackgroundBuilder::append(const BackgroundBuilder& other) {
  const auto before = std::uint32_t(runs_.runCount());
  for (const std::uint32_t start : other.runs_.columnStart) runs_.columnStart.push_back(before + start);
  const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  add(runs_.firstRow, other.runs_.firstRow);
  add(runs_.endRow, other.runs_.endRow);
  add(runs_.roles, other.runs_.roles);
}

CaptureBackground BackgroundBuilder::finish(const Sky& sky) && {
  if (runs_.runCount() == 0) return {};
  runs_.sky = sky;
  runs_.columnStart.insert(runs_.columnStart.begin(), 0);
  return std::move(runs_);
}

std::size_t Capture::bytes() const {
  return CaptureSamples::bytes() + background.bytes() + reflections.bytes();
}

Status Capture::check() const {
  if (auto sound = camera.check(); !sound) return sound;
  if (!(distanceStep >= 0) || !std::isfinite(distanceStep))
    return malformedCapture("the step of its distances is not a finite number >= 0");
  if (!std::isfinite(planeTolerance) ||
      (planeTolerance > 0) != (hasSilhouettes() || reflections.hasSilhouettes()))
    return malformedCapture("the tolerance of its planes is not above 0 with silhouettes, and 0 without");
  const auto columns = static_cast<std::size_t>(camera.columns);
  if (auto sound = checkArrays(*this, columns, hasReflections(), "sample"); !sound) return sound;
  if (auto sound = checkSamples(*this, camera, false, "sample"); !sound) return sound;
  if (auto sound = checkBackground(background, camera); !sound) return sound;
  if (reflections == CaptureSamples{}) return {};
  if (!hasReflections()) return malformedCapture("its list of reflections is there, and empty");
  if (auto sound = checkArrays(reflections, columns, true, "reflection"); !sound) return sound;
  return checkSamples(reflections, camera, true, "reflection");
}

}  // namespace acentric
