#include "engine/inspect/standing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/geometry/conventions.h"

namespace acentric {
namespace {

constexpr int kSides = 8;          // directions in which obstacles are looked for
constexpr double kInside = 0.8;    // share of what is around that shows its back, inside a solid
constexpr double kStride = 0.125;  // metres between the feet on stairs: less than a tread
constexpr int kMostStrides = 64;
constexpr double kSteepestClimb = 1.2;  // metres up per metre along

/// Heights above the floor at which obstacles count: between knee and head.
std::array<double, 3> probeHeights(double eyeHeight) {
  const double knee = std::min(0.5, 0.3 * eyeHeight);
  return {knee, 0.5 * (knee + eyeHeight), eyeHeight};
}

/// Metres without an obstacle towards +x, +y, -x, -y.
using FreeWay = std::array<float, 4>;

bool canStandWithin(const glm::dvec2& at, const FloorLevel& level, const StandingRules& rules,
                    const std::array<double, 3>& heights, const SurfaceProbe& probe, FreeWay& freeWay) {
  int found = 0, backs = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (int d = 0; d < kSides; ++d) {
    const glm::dvec3 direction(directionOf(kTwoPi * d / kSides), 0);
    double least = std::numeric_limits<double>::infinity();
    for (const double above : heights) {
      const SurfaceHit hit = probe({at, double(level.height) + above}, direction);
      if (!hit.found()) continue;
      least = std::min(least, hit.distance);
      ++found;
      if (hit.showsBack(direction)) ++backs;
    }
    nearest = std::min(nearest, least);
    if (d % 2 == 0) freeWay[std::size_t(d / 2)] = static_cast<float>(least);
  }
  if (nearest < rules.wallClearance) return false;
  const bool inside = level.coverIsBack && found > kSides && backs >= kInside * found;
  return !(rules.refuseInside && inside);
}

class Surveyor {
 public:
  Surveyor(const ProbeGrid& grid, const StandingRules& rules, const SurfaceProbe& probe)
      : grid_(grid), rules_(rules), heights_(probeHeights(rules.eyeHeight)), probe_(probe) {}

  bool canStand(const glm::dvec2& at, const FloorLevel& level, FreeWay& freeWay) const {
    return canStandWithin(at, level, rules_, heights_, probe_, freeWay);
  }

  bool canStep(const StandingSpot& from, const StandingSpot& to, float there, float back) const {
    const double rise = std::abs(double(from.height) - double(to.height));
    if (rise <= rules_.stepHeight && std::min(there, back) >= static_cast<float>(grid_.step)) return true;
    // Worth a walk only where stairs could lead: level ground with something between is an obstacle.
    if (rise <= rules_.stepHeight || rise > rules_.stepHeight + kSteepestClimb * grid_.step) return false;
    return canWalk(from, to);
  }

 private:
  /// Feels for the ground between two spots, stride by stride, with room for the body.
  bool canWalk(const StandingSpot& from, const StandingSpot& to) const {
    const glm::dvec2 begin = grid_.centreOf(from.x, from.y), end = grid_.centreOf(to.x, to.y);
    const int strides = std::clamp(static_cast<int>(std::ceil(grid_.step / kStride)), 1, kMostStrides);
    glm::dvec3 foot(begin, from.height);
    for (int k = 1; k <= strides; ++k) {
      const glm::dvec2 at = glm::mix(begin, end, double(k) / strides);
      const double reach = foot.z + rules_.stepHeight;
      const SurfaceHit ground = probe_({at, reach + 1e-3}, {0, 0, -1});
      if (!ground.found() || ground.distance > 2 * rules_.stepHeight + 2e-3) return false;
      const glm::dvec3 next(at, reach + 1e-3 - ground.distance);
      if (!bodyFits(foot, next)) return false;
      foot = next;
    }
    return std::abs(foot.z - double(to.height)) <= 0.5 * rules_.stepHeight;
  }

  bool bodyFits(const glm::dvec3& from, const glm::dvec3& to) const {
    const double length = glm::distance(from, to);
    const glm::dvec3 direction = (to - from) / length;
    return std::ranges::all_of(heights_, [&](double above) {
      return !(probe_(from + glm::dvec3(0, 0, above), direction).distance < length);
    });
  }

  const ProbeGrid& grid_;
  const StandingRules& rules_;
  std::array<double, 3> heights_;
  const SurfaceProbe& probe_;
};

}  // namespace

bool canStand(const glm::dvec2& place, const FloorLevel& level, const StandingRules& rules,
              const SurfaceProbe& probe) {
  FreeWay freeWay{};
  return canStandWithin(place, level, rules, probeHeights(rules.eyeHeight), probe, freeWay);
}

Standing surveyStanding(const ProbeGrid& grid, const FloorLevels& levels, const StandingRules& rules,
                        const SurfaceProbe& probe) {
  const Surveyor surveyor(grid, rules, probe);
  Standing standing{grid, {}};
  std::vector<FreeWay> freeWays;
  std::vector<int> firstOfCell(levels.size() + 1, 0);
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x) {
      const std::size_t cell = grid.index(x, y);
      for (const FloorLevel& level : levels[cell]) {
        FreeWay freeWay{};
        if (!surveyor.canStand(grid.centreOf(x, y), level, freeWay)) continue;
        standing.spots.push_back({x, y, level.height, level.covered});
        freeWays.push_back(freeWay);
      }
      firstOfCell[cell + 1] = static_cast<int>(standing.spots.size());
    }

  // A cell's spots are a head room apart, so the nearest in height is the only one that a step could reach.
  const auto nearestIn = [&](std::size_t cell, float height) {
    int nearest = -1;
    for (int s = firstOfCell[cell]; s < firstOfCell[cell + 1]; ++s)
      if (nearest < 0 || std::abs(standing.spots[std::size_t(s)].height - height) <
                             std::abs(standing.spots[std::size_t(nearest)].height - height))
        nearest = s;
    return nearest;
  };
  for (std::size_t s = 0; s < standing.spots.size(); ++s) {
    StandingSpot& spot = standing.spots[s];
    for (const std::size_t side : {std::size_t(0), std::size_t(1)}) {
      const int x = spot.x + (side == 0 ? 1 : 0), y = spot.y + (side == 1 ? 1 : 0);
      if (x >= grid.columns || y >= grid.rows) continue;
      const int other = nearestIn(grid.index(x, y), spot.height);
      if (other < 0) continue;
      StandingSpot& neighbour = standing.spots[std::size_t(other)];
      if (neighbour.next[side + 2] >= 0 ||
          !surveyor.canStep(spot, neighbour, freeWays[s][side], freeWays[std::size_t(other)][side + 2]))
        continue;
      spot.next[side] = other;
      neighbour.next[side + 2] = static_cast<int>(s);
    }
  }
  return standing;
}

}  // namespace acentric
