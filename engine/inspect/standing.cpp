#include "engine/inspect/standing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/task_runner.h"
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

/// What is around a place to stand.
struct Body {
  bool fits = false;
  bool seemsInside = false;
  float clearance = 0, enclosure = 0, wideEnclosure = 0;
  FreeWay freeWay{};
};

/// How much a surface at a distance encloses, 0..1.
double wallAt(double distance, const StandingRules& rules) {
  return std::clamp((rules.farthestWall - distance) / (rules.farthestWall - rules.wallReach), 0.0, 1.0);
}

Body feelAround(const glm::dvec2& at, const FloorLevel& level, const StandingRules& rules,
                const std::array<double, 3>& heights, const SurfaceProbe& probe) {
  Body body;
  int found = 0, backs = 0, near = 0;
  double walls = 0;
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
      if (above != rules.eyeHeight) continue;
      near += hit.distance <= rules.wallReach ? 1 : 0;
      walls += wallAt(hit.distance, rules);
    }
    nearest = std::min(nearest, least);
    if (d % 2 == 0) body.freeWay[std::size_t(d / 2)] = static_cast<float>(least);
  }
  body.enclosure = static_cast<float>(near) / kSides;
  body.wideEnclosure = static_cast<float>(walls / kSides);
  body.clearance = static_cast<float>(nearest);
  body.fits = nearest >= rules.wallClearance;
  const bool open = found <= kSides;  // hardly anything around tells anything
  body.seemsInside = level.maybeInside && (open ? level.faceDown : backs >= kInside * found);
  return body;
}

class Surveyor {
 public:
  Surveyor(const ProbeGrid& grid, const StandingRules& rules, const SurfaceProbe& probe)
      : grid_(grid), rules_(rules), heights_(probeHeights(rules.eyeHeight)), probe_(probe) {}

  Body feel(const glm::dvec2& at, const FloorLevel& level) const {
    return feelAround(at, level, rules_, heights_, probe_);
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

/// Takes the parts out that are inside solids.
void dropInsides(Standing& standing) {
  const std::vector<int> part = numberParts(standing, std::vector<std::uint8_t>(standing.spots.size(), 1));
  std::vector<int> vote;  // per part: spots that seem inside, less the others
  for (std::size_t s = 0; s < part.size(); ++s) {
    if (std::size_t(part[s]) >= vote.size()) vote.resize(std::size_t(part[s]) + 1, 0);
    vote[std::size_t(part[s])] += standing.spots[s].seemsInside ? 1 : -1;
  }
  std::vector<int> newIndex(part.size(), -1);
  std::vector<StandingSpot> kept;
  for (std::size_t s = 0; s < part.size(); ++s) {
    if (vote[std::size_t(part[s])] > 0) continue;
    newIndex[s] = static_cast<int>(kept.size());
    kept.push_back(standing.spots[s]);
  }
  for (StandingSpot& spot : kept)
    for (int& next : spot.next)
      if (next >= 0) next = newIndex[std::size_t(next)];
  standing.spots = std::move(kept);
}

}  // namespace

std::vector<int> numberParts(const Standing& standing, const std::vector<std::uint8_t>& included) {
  std::vector<int> part(standing.spots.size(), -1);
  std::vector<int> open;
  int parts = 0;
  for (std::size_t first = 0; first < part.size(); ++first) {
    if (included[first] == 0 || part[first] >= 0) continue;
    part[first] = parts;
    open.assign(1, static_cast<int>(first));
    while (!open.empty()) {
      const int spot = open.back();
      open.pop_back();
      for (const int next : standing.spots[std::size_t(spot)].next)
        if (next >= 0 && included[std::size_t(next)] != 0 && part[std::size_t(next)] < 0)
          part[std::size_t(next)] = parts, open.push_back(next);
    }
    ++parts;
  }
  return part;
}

bool canStand(const glm::dvec2& place, const FloorLevel& level, const StandingRules& rules,
              const SurfaceProbe& probe) {
  const Body body = feelAround(place, level, rules, probeHeights(rules.eyeHeight), probe);
  return body.fits && !(rules.refuseInside && body.seemsInside);
}

Standing surveyStanding(const ProbeGrid& grid, const FloorLevels& levels, const StandingRules& rules,
                        const SurfaceProbe& probe, TaskRunner* runner) {
  const Surveyor surveyor(grid, rules, probe);
  TaskRunner inTurn;
  TaskRunner& look = runner != nullptr ? *runner : inTurn;
  std::vector<std::vector<Body>> bodies(levels.size());  // by cell and level
  look.parallelFor(std::size_t(grid.rows), [&](std::size_t y) {
    for (int x = 0; x < grid.columns; ++x) {
      const std::size_t cell = grid.index(x, int(y));
      for (const FloorLevel& level : levels[cell])
        bodies[cell].push_back(surveyor.feel(grid.centreOf(x, int(y)), level));
    }
  });
  Standing standing{grid, {}};
  std::vector<FreeWay> freeWays;
  std::vector<int> firstOfCell(levels.size() + 1, 0);
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x) {
      const std::size_t cell = grid.index(x, y);
      for (std::size_t n = 0; n < levels[cell].size(); ++n) {
        const FloorLevel& level = levels[cell][n];
        const Body& body = bodies[cell][n];
        if (!body.fits) continue;
        standing.spots.push_back({x, y, level.height, level.covered, body.seemsInside, body.clearance,
                                  body.enclosure, body.wideEnclosure});
        freeWays.push_back(body.freeWay);
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
  // Towards +x and +y: the spot that a step leads to, or -1.
  std::vector<std::array<int, 2>> steps(standing.spots.size(), {-1, -1});
  look.parallelFor(std::size_t(grid.rows), [&](std::size_t row) {
    const int first = firstOfCell[grid.index(0, int(row))];
    const int end = firstOfCell[grid.index(grid.columns - 1, int(row)) + 1];
    for (auto s = std::size_t(first); s < std::size_t(end); ++s) {
      const StandingSpot& spot = standing.spots[s];
      for (const std::size_t side : {std::size_t(0), std::size_t(1)}) {
        const int x = spot.x + (side == 0 ? 1 : 0), y = spot.y + (side == 1 ? 1 : 0);
        if (x >= grid.columns || y >= grid.rows) continue;
        const int other = nearestIn(grid.index(x, y), spot.height);
        if (other >= 0 && surveyor.canStep(spot, standing.spots[std::size_t(other)], freeWays[s][side],
                                           freeWays[std::size_t(other)][side + 2]))
          steps[s][side] = other;
      }
    }
  });
  for (std::size_t s = 0; s < standing.spots.size(); ++s)
    for (const std::size_t side : {std::size_t(0), std::size_t(1)}) {
      if (steps[s][side] < 0) continue;
      StandingSpot& neighbour = standing.spots[std::size_t(steps[s][side])];
      if (neighbour.next[side + 2] >= 0) continue;
      standing.spots[s].next[side] = steps[s][side];
      neighbour.next[side + 2] = static_cast<int>(s);
    }
  if (rules.refuseInside) dropInsides(standing);
  return standing;
}

}  // namespace acentric
