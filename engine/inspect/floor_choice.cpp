#include "engine/inspect/floor_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace acentric {
namespace {

tl::unexpected<Error> none(const std::string& what) {
  return fail(ErrorKind::notFound,
              fmt::format("{}; lower the eye height, or give the floor height or the outline yourself", what),
              "walkable area");
}

constexpr double kOpenGround = 0.01;  // what a spot counts that nothing encloses
constexpr int kMostParts = 16;        // of the floor at one height
constexpr double kSmallPart = 0.1;    // of the largest part's area: a hut on its ground
constexpr double kNoWalls = 0.05;     // mean enclosure on the outside of a box around everything
constexpr double kHiddenFloor = 0.1;  // share of such an outside with floor below

/// How much a spot counts for the choice of the floor. Who stands before a building sees surfaces in half of
/// the directions at most, in a room or a street in more: only what is beyond half counts. Where nothing is
/// enclosed, area decides. `known` is the share of the spot's cell that lies within reach of its walls: of a
/// cell of 400 m, one rock beside its middle encloses next to nothing.
double worthOf(double enclosure, double known) { return std::max(kOpenGround, known * (2 * enclosure - 1)); }

double knownShare(const ProbeGrid& grid) {
  const double share = 2 * StandingRules{}.wallReach / grid.step;
  return std::min(1.0, share * share);
}

bool hasFloorBelow(const StandingSpot& spot, const std::vector<FloorLevel>& here, bool ignoreSides) {
  return std::ranges::any_of(here, [&](const FloorLevel& level) {
    return level.height < spot.height && (ignoreSides || !level.maybeInside);  // no underside of the ground
  });
}

/// All spots but those on a roof: under the open sky with another floor below, which furniture may fill. If
/// there are no others, all.
std::vector<WeightedHeight> heightsBelowRoofs(const Standing& standing, const FloorLevels& levels,
                                              bool ignoreSides) {
  std::vector<WeightedHeight> below, all;
  const double known = knownShare(standing.grid);
  for (const StandingSpot& spot : standing.spots) {
    const auto& here = levels[standing.grid.index(spot.x, spot.y)];
    all.push_back({spot.height, worthOf(spot.wideEnclosure, known), worthOf(spot.enclosure, 1)});
    if (spot.covered || !hasFloorBelow(spot, here, ignoreSides)) below.push_back(all.back());
  }
  return below.empty() ? all : below;
}

double worthOf(const WalkPlane& plane, const Standing& standing) {
  double worth = 0;
  const double known = knownShare(standing.grid);
  for (const int spot : plane.spots) worth += worthOf(standing.spots[std::size_t(spot)].wideEnclosure, known);
  return worth;
}

struct FloorCandidate {
  FloorChoice choice;
  double worth = 0;
  bool onHull = false;  ///< see liesOnHull
};

/// Is the floor the outside of a closed box around everything? No walls are near, and below much of it is
/// floor that faces up inside what seems a solid. (The inside of a solid ground has none.)
bool liesOnHull(const WalkPlane& plane, const Standing& standing, const FloorLevels& levels) {
  if (plane.enclosure > kNoWalls) return false;
  const auto hidden = std::ranges::count_if(plane.spots, [&](int s) {
    const StandingSpot& spot = standing.spots[std::size_t(s)];
    return std::ranges::any_of(levels[standing.grid.index(spot.x, spot.y)], [&](const FloorLevel& level) {
      return level.height < spot.height && level.maybeInside && !level.faceDown;
    });
  });
  return double(hidden) > kHiddenFloor * double(plane.spots.size());
}

Result<FloorCandidate> candidateOn(const Bounds& bounds, const ProbeGrid& grid,
                                   const WalkableOptions& options, const SurfaceProbe& probe) {
  FloorLevels levels = findFloorLevels(bounds, grid, options.headRoom(), probe);
  std::optional<double> height = options.floorHeight;
  const bool given = !std::isnan(options.floorHeight);
  if (given)
    for (auto& here : levels)
      std::erase_if(here, [&](const FloorLevel& level) {
        return std::abs(double(level.height) - options.floorHeight) > options.floorTolerance;
      });
  Standing standing = surveyStanding(grid, levels, options.standingRules(), probe, options.runner);
  if (!given)
    height = dominantHeight(heightsBelowRoofs(standing, levels, options.ignoreSides), options.floorTolerance);
  if (!height)
    return none(fmt::format("no surface has {:.2f} m of room above it and {:.2f} m to the sides",
                            options.headRoom(), options.wallClearance));
  std::vector<WalkPlane> planes = planesAt(standing, *height, options.floorTolerance, given ? 1 : kMostParts);
  if (planes.empty())
    return none(
        fmt::format("no place at height {:.2f} m has {:.2f} m of room above it and {:.2f} m to the sides",
                    *height, options.headRoom(), options.wallClearance));
  const double enough = kSmallPart * planes.front().outline.area();
  std::erase_if(planes, [&](const WalkPlane& plane) { return plane.outline.area() < enough; });
  const auto best =
      std::ranges::max_element(planes, {}, [&](const WalkPlane& plane) { return worthOf(plane, standing); });
  const double worth = worthOf(*best, standing);
  const bool onHull = !given && liesOnHull(*best, standing, levels);
  best->height = *height;
  FloorChoice choice{{*height, best->outline, options.ignoreSides}, std::move(*best), std::move(standing)};
  return FloorCandidate{std::move(choice), worth, onHull};
}

}  // namespace

Result<FloorChoice> chooseFloor(const Bounds& bounds, const ProbeGrid& grid, const WalkableOptions& options,
                                const SurfaceProbe& probe) {
  auto candidate = candidateOn(bounds, grid, options, probe);
  const auto chosen = [](Result<FloorCandidate>& found) -> Result<FloorChoice> {
    if (!found) return tl::unexpected(found.error());
    return std::move(found->choice);
  };
  const bool none = !candidate && candidate.error().kind == ErrorKind::notFound;
  if (options.ignoreSides || !(none || (candidate && candidate->onHull))) return chosen(candidate);
  WalkableOptions anySide = options;
  anySide.ignoreSides = true;
  auto second = candidateOn(bounds, grid, anySide, probe);
  const bool better = second && (none || second->worth > candidate->worth);
  return chosen(better ? second : candidate);
}

}  // namespace acentric
