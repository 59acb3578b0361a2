#include "engine/view/slant.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace acentric {
namespace {

/// Up to this tangent (some 72 degrees) both sides of a sample count as its surface.
constexpr float kConnected = 3;
/// Inverse distances that differ by more than this part belong to different surfaces, whatever the pitch.
constexpr float kBroken = 0.25f;

/// Samples of one pixel, [first, last).
struct Pixel {
  std::uint32_t first = 0, last = 0;
};

/// Walks a column downwards.
class ColumnCursor {
 public:
  ColumnCursor(std::span<const std::uint16_t> row, std::uint32_t begin, std::uint32_t end)
      : row_(row), at_(begin), end_(end) {}
  /// The samples of a row; rows must not fall from call to call.
  Pixel pixel(int wanted) {
    while (at_ < end_ && row_[at_] < wanted) ++at_;
    Pixel found{at_, at_};
    while (found.last < end_ && row_[found.last] == wanted) ++found.last;
    return found;
  }

 private:
  std::span<const std::uint16_t> row_;
  std::uint32_t at_, end_;
};

/// From the nearest in depth of a pixel's samples to `inverse`; infinity if there is none.
float stepFrom(std::span<const float> inverseDistance, const Pixel& pixel, float inverse) {
  float step = std::numeric_limits<float>::infinity();
  for (std::uint32_t i = pixel.first; i < pixel.last; ++i)
    if (const float s = inverse - inverseDistance[i]; std::abs(s) < std::abs(step)) step = s;
  return step;
}

std::int8_t leaning(float fromBefore, float toAfter, float inverse, float pitch) {
  float flatter = fromBefore, steeper = toAfter;
  if (std::abs(flatter) > std::abs(steeper)) std::swap(flatter, steeper);
  const float step = std::abs(steeper) < kConnected * inverse * pitch ? steeper : flatter;
  return std::abs(step) < kBroken * inverse ? slantCode(double(step) / (double(inverse) * double(pitch)))
                                            : std::int8_t(0);
}

}  // namespace

std::int8_t slantCode(double tangent) {
  const double size = std::abs(tangent);
  const int code = std::min(int(std::lround(127 - 127 / (1 + size))), kLargestSlantCode);
  return std::int8_t(tangent < 0 ? -code : code);
}

double slantTangent(std::int8_t code) { return double(code) / (127 - std::abs(int(code))); }

std::vector<Slant> slantsOf(const ColumnCamera& camera, std::span<const std::uint32_t> columnStart,
                            std::span<const std::uint16_t> row, std::span<const float> inverseDistance) {
  std::vector<Slant> slants(row.size());
  const float columnPitch = float(camera.columnPitch()), rowPitch = float(camera.rowPitch());
  const auto cursor = [&](std::size_t column) {
    return column + 1 < columnStart.size() ? ColumnCursor(row, columnStart[column], columnStart[column + 1])
                                           : ColumnCursor(row, 0, 0);
  };
  for (std::size_t k = 0; k + 1 < columnStart.size(); ++k) {
    ColumnCursor left = k > 0 ? cursor(k - 1) : ColumnCursor(row, 0, 0), right = cursor(k + 1);
    ColumnCursor above = cursor(k), below = cursor(k);
    for (std::uint32_t i = columnStart[k]; i < columnStart[k + 1]; ++i) {
      const float w = inverseDistance[i];
      if (!(w > 0)) continue;
      const float fromLeft = stepFrom(inverseDistance, left.pixel(row[i]), w),
                  toRight = -stepFrom(inverseDistance, right.pixel(row[i]), w),
                  fromAbove = stepFrom(inverseDistance, above.pixel(row[i] - 1), w),
                  toBelow = -stepFrom(inverseDistance, below.pixel(row[i] + 1), w);
      slants[i] = {leaning(fromLeft, toRight, w, columnPitch), leaning(fromAbove, toBelow, w, rowPitch)};
    }
  }
  return slants;
}

}  // namespace acentric
