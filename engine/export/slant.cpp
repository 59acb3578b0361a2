#include "engine/export/slant.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace acentric {
namespace {

/// Up to this tangent (some 72 degrees) both sides of a sample count as its surface.
constexpr float kConnected = 3;
/// Inverse distances that differ by more than this part belong to different surfaces, whatever the pitch.
constexpr float kBroken = 0.25f;
/// So do samples that a surface would join at a larger tangent (some 84 degrees), unless it goes on as evenly
/// on the other side: few surfaces are seen at such a slant, and edges before others are many.
constexpr float kSteepest = 10, kEven = 1.5f;
/// So even that it is no accident.
constexpr float kStraight = 1.02f;

/// Where the two sides of a round body run together they lie farther apart by more than this a pixel further
/// in.
constexpr float kRunsTogether = 1.2f;

/// Samples of one pixel, [first, last).
struct Pixel {
  std::uint32_t first = 0, last = 0;
};

/// Walks a column downwards.
class ColumnCursor {
 public:
  ColumnCursor(std::span<const std::uint16_t> row, std::uint32_t begin, std::uint32_t end)
      : row_(row), at_(begin), end_(end) {}
  bool atEnd() const { return at_ == end_; }
  int rowAt() const { return row_[at_]; }
  /// The samples of a row, which lies below those asked for before. The cursor then stands behind them.
  Pixel pixel(int wanted) {
    while (at_ < end_ && row_[at_] < wanted) ++at_;
    const std::uint32_t first = at_;
    while (at_ < end_ && row_[at_] == wanted) ++at_;
    return {first, at_};
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

std::int8_t codeOf(float tangent) {
  const float size = std::abs(tangent);
  if (!(size > 0))
    return 0;  // also 0/0, of distances so large that floats hold no products of their inverses
  const int code = std::min(static_cast<int>(127.5f - 127.0f / (1 + size)), kLargestSlantCode);
  return static_cast<std::int8_t>(tangent < 0 ? -code : code);
}

/// Inverse distances, each less the one before it: towards a sample and on from it, along a row or column.
struct Steps {
  float to = 0, from = 0;
  float steepest() const { return std::max(std::abs(to), std::abs(from)); }
  bool even(float most) const {
    return to * from > 0 && std::abs(to) < most * std::abs(from) && std::abs(from) < most * std::abs(to);
  }
};

std::int8_t leaning(const Steps& steps, float inverse, float pitch) {
  float flatter = steps.to, steeper = steps.from;
  if (std::abs(flatter) > std::abs(steeper)) std::swap(flatter, steeper);
  const float broken = (steps.even(kEven) ? kBroken : std::min(kBroken, kSteepest * pitch)) * inverse;
  const bool gentle = std::abs(flatter) < kConnected * inverse * pitch;
  // A surface that turns away at its edge.
  if (!(std::abs(steeper) < broken) && !gentle) return 0;
  const float step = std::abs(steeper) < kConnected * inverse * pitch ? steeper : flatter;
  return std::abs(step) < broken ? codeOf(step / (inverse * pitch)) : std::int8_t(0);
}

/// Where several surfaces lie close behind each other, as glass before a picture, those nearest in depth on
/// either side may be of different ones: the steps that lie most nearly on one line.
Steps straightest(std::span<const float> inverseDistance, const Pixel& before, const Pixel& after,
                  float inverse) {
  Steps best{std::numeric_limits<float>::infinity(), 0};
  for (std::uint32_t i = before.first; i < before.last; ++i)
    for (std::uint32_t j = after.first; j < after.last; ++j)
      if (const Steps steps{inverse - inverseDistance[i], inverseDistance[j] - inverse};
          std::abs(steps.to - steps.from) < std::abs(best.to - best.from))
        best = steps;
  return best;
}

/// At the rim of a round body, which rays enter and leave again near by: how much nearer its other side is,
/// of the same pixel. Else 0. `inner`, `outer`: the pixels beside it, with the body on and off it.
float toOtherSide(std::span<const float> inverseDistance, const Pixel& here, const Pixel& inner,
                  const Pixel& outer, std::uint32_t sample) {
  const float own = inverseDistance[sample];
  float other = 0;
  for (std::uint32_t i = here.first; i < here.last; ++i)
    if (i != sample && std::abs(inverseDistance[i] - own) < std::abs(other - own)) other = inverseDistance[i];
  const float gap = other - own;
  if (!(std::abs(gap) < kBroken * own)) return 0;
  const auto goesOn = [&](float inverse) {
    return std::abs(stepFrom(inverseDistance, outer, inverse)) <= std::abs(gap);
  };
  if (goesOn(own) || goesOn(other)) return 0;
  const auto furtherIn = [&](float inverse) { return inverse - stepFrom(inverseDistance, inner, inverse); };
  const float before = furtherIn(other) - furtherIn(own);
  return before * gap > 0 && std::abs(before) > kRunsTogether * std::abs(gap) &&
                 std::abs(before) < kBroken * own
             ? gap
             : 0;
}

/// The slant of a sample along one axis, `before` and `after` being the pixels beside it.
std::int8_t slantAlong(std::span<const float> inverseDistance, const Pixel& before, const Pixel& here,
                       const Pixel& after, std::uint32_t sample, float pitch) {
  const float own = inverseDistance[sample];
  if (here.last - here.first > 1) {
    const float forwards = toOtherSide(inverseDistance, here, before, after, sample);
    const float step = forwards != 0 ? forwards : -toOtherSide(inverseDistance, here, after, before, sample);
    if (step != 0) return codeOf(step / (own * pitch));
  }
  const Steps nearest{stepFrom(inverseDistance, before, own), -stepFrom(inverseDistance, after, own)};
  if (nearest.steepest() >= kConnected * own * pitch && !nearest.even(kStraight))
    if (const Steps steps = straightest(inverseDistance, before, after, own); steps.even(kStraight))
      return leaning(steps, own, pitch);
  return leaning(nearest, own, pitch);
}

}  // namespace

std::int8_t slantCode(double tangent) { return codeOf(static_cast<float>(tangent)); }

double slantTangent(std::int8_t code) { return double(code) / (127 - std::abs(int(code))); }

std::vector<Slant> slantsOf(const ColumnCamera& camera, std::span<const std::uint32_t> columnStart,
                            std::span<const std::uint16_t> row, std::span<const float> inverseDistance) {
  std::vector<Slant> slants(row.size());
  const float columnPitch = float(camera.columnPitch()), rowPitch = float(camera.rowPitch());
  const auto cursor = [&](std::size_t column) {  // also of the columns beside the first and the last
    return column < columnStart.size() - 1 ? ColumnCursor(row, columnStart[column], columnStart[column + 1])
                                           : ColumnCursor(row, 0, 0);
  };
  for (std::size_t k = 0; k + 1 < columnStart.size(); ++k) {
    ColumnCursor left = cursor(k - 1), own = cursor(k), right = cursor(k + 1);
    Pixel above;
    for (int rowAbove = -2; !own.atEnd();) {
      const int r = own.rowAt();
      const Pixel here = own.pixel(r);
      const Pixel below = ColumnCursor(own).pixel(r + 1);
      if (rowAbove != r - 1) above = {};
      const Pixel beforeIt = left.pixel(r), afterIt = right.pixel(r);
      for (std::uint32_t i = here.first; i < here.last; ++i) {
        if (!(inverseDistance[i] > 0)) continue;
        slants[i] = {slantAlong(inverseDistance, beforeIt, here, afterIt, i, columnPitch),
                     slantAlong(inverseDistance, above, here, below, i, rowPitch)};
      }
      above = here;
      rowAbove = r;
    }
  }
  return slants;
}

}  // namespace acentric
