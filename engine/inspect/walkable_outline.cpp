#include "engine/inspect/walkable_outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/inspect/walk_plane.h"

namespace acentric {
namespace {

constexpr double kHeadAboveEye = 0.15;  // metres
constexpr int kStandardCells = 200;     // along the longer side
constexpr double kMostCells = 4e6;

tl::unexpected<Error> refuse(std::string message) {
  return fail(ErrorKind::invalidArgument, std::move(message), "walkable area");
}

Status checkRange(const char* what, double value, double low, double high) {
  if (value >= low && value <= high) return {};
  return refuse(fmt::format("{} is {} m; it must lie in {}..{} m", what, value, low, high));
}

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
/// enclosed, area decides.
double worthOf(const StandingSpot& spot) { return std::max(kOpenGround, 2 * double(spot.enclosure) - 1); }

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
  for (const StandingSpot& spot : standing.spots) {
    const auto& here = levels[standing.grid.index(spot.x, spot.y)];
    all.push_back({spot.height, worthOf(spot)});
    if (spot.covered || !hasFloorBelow(spot, here, ignoreSides)) below.push_back(all.back());
  }
  return below.empty() ? all : below;
}

double worthOf(const WalkPlane& plane, const Standing& standing) {
  double worth = 0;
  for (const int spot : plane.spots) worth += worthOf(standing.spots[std::size_t(spot)]);
  return worth;
}

struct FoundArea {
  WalkableArea area;
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

Result<FoundArea> findArea(const Bounds& bounds, const ProbeGrid& grid, const WalkableOptions& options,
                           const SurfaceProbe& probe) {
  FloorLevels levels = findFloorLevels(bounds, grid, options.headRoom(), probe);
  std::optional<double> height = options.floorHeight;
  const bool given = !std::isnan(options.floorHeight);
  if (given)
    for (auto& here : levels)
      std::erase_if(here, [&](const FloorLevel& level) {
        return std::abs(double(level.height) - options.floorHeight) > options.floorTolerance;
      });
  const Standing standing = surveyStanding(grid, levels, options.standingRules(), probe);
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
  return FoundArea{WalkableArea{*height, std::move(best->outline), options.ignoreSides},
                   worthOf(*best, standing), !given && liesOnHull(*best, standing, levels)};
}

}  // namespace

Status WalkableOptions::check() const {
  for (const Status& status : {checkRange("the eye height", eyeHeight, 0.001, 1000),
                               checkRange("the floor tolerance", floorTolerance, 0, 100),
                               checkRange("the step height", stepHeight, 0, 100),
                               checkRange("the wall clearance", wallClearance, 0, 100),
                               checkRange("the grid step", gridStep, 0, 1e6)})
    if (!status) return status;
  if (std::isinf(floorHeight)) return refuse("the floor height must be finite, or left out");
  return {};
}

double WalkableOptions::headRoom() const { return eyeHeight + kHeadAboveEye; }

StandingRules WalkableOptions::standingRules() const {
  return {eyeHeight, wallClearance, stepHeight, !ignoreSides};
}

Result<ProbeGrid> layProbeGrid(const Bounds& bounds, const WalkableOptions& options) {
  const glm::dvec3 low(bounds.min), size = glm::dvec3(bounds.max) - low;
  if (bounds.empty() || !std::isfinite(size.x + size.y + size.z) || !(size.x > 0 && size.y > 0))
    return fail(ErrorKind::notFound, "the scene has no extent in plan, so there is no floor to walk on",
                "walkable area");
  ProbeGrid grid;
  grid.corner = glm::dvec2(low);
  grid.step = options.gridStep > 0 ? options.gridStep : std::max(size.x, size.y) / kStandardCells;
  const glm::dvec2 cells = glm::ceil(glm::dvec2(size) / grid.step);
  if (cells.x * cells.y > kMostCells)
    return fail(
        ErrorKind::tooLarge,
        fmt::format("a grid step of {} m makes {:.0f} points, more than {:.0f}; choose {:.2g} m or more",
                    grid.step, cells.x * cells.y, kMostCells,
                    1.1 * grid.step * std::sqrt(cells.x * cells.y / kMostCells)),
        "walkable area");
  grid.columns = std::max(1, static_cast<int>(cells.x));
  grid.rows = std::max(1, static_cast<int>(cells.y));
  return grid;
}

Result<WalkableArea> findWalkableArea(const Bounds& bounds, const WalkableOptions& options,
                                      const SurfaceProbe& probe) {
  if (Status status = options.check(); !status) return tl::unexpected(status.error());
  const Result<ProbeGrid> grid = layProbeGrid(bounds, options);
  if (!grid) return tl::unexpected(grid.error());
  auto area = findArea(bounds, *grid, options, probe);
  const auto outlineOf = [](Result<FoundArea>& found) -> Result<WalkableArea> {
    if (!found) return tl::unexpected(found.error());
    return std::move(found->area);
  };
  const bool none = !area && area.error().kind == ErrorKind::notFound;
  if (options.ignoreSides || !(none || (area && area->onHull))) return outlineOf(area);
  WalkableOptions anySide = options;
  anySide.ignoreSides = true;
  auto second = findArea(bounds, *grid, anySide, probe);
  const bool better = second && (none || second->worth > area->worth);
  return outlineOf(better ? second : area);
}

}  // namespace acentric
