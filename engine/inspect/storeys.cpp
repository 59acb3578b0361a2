#include "engine/inspect/storeys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "engine/inspect/floor_choice.h"

namespace acentric {
namespace {

constexpr int kMostPlanes = 64;
constexpr std::size_t kMostLinksPerPair = 4;

/// Takes the fullest height out of the heights that are left, until what a height holds is too little.
class HeightQueue {
 public:
  HeightQueue(const Standing& standing, const std::vector<std::uint8_t>& taken, double tolerance)
      : tolerance_(tolerance) {
    for (std::size_t s = 0; s < taken.size(); ++s)
      if (taken[s] == 0) heights_.push_back(standing.spots[s].height);
    std::ranges::sort(heights_);
  }

  /// Median of the span of twice the tolerance that holds most; nothing where it holds fewer than `least`.
  std::optional<double> takeFullest(double least) {
    std::size_t best = 0, most = 0;
    for (std::size_t k = 0, end = 0; k < heights_.size(); ++k) {
      while (end < heights_.size() && heights_[end] <= heights_[k] + 2 * tolerance_) ++end;
      if (end - k > most) best = k, most = end - k;
    }
    if (most == 0 || double(most) < least) return std::nullopt;
    const double middle = heights_[best + most / 2];
    std::erase_if(heights_, [&](double height) { return std::abs(height - middle) <= tolerance_; });
    return middle;
  }

 private:
  double tolerance_;
  std::vector<double> heights_;
};

/// By spot: 1 on the outside of a sky box, which is the top of all, level over nearly all of the plan, and
/// high above all other ground.
std::vector<std::uint8_t> skyOf(const Standing& standing, double tolerance) {
  constexpr double kNearlyAll = 0.8;
  constexpr float kSkyHeight = 20;  // metres: a roof is nearer
  std::vector<std::uint8_t> sky(standing.spots.size(), 0);
  if (sky.empty()) return sky;
  const float top = std::ranges::max(standing.spots, {}, &StandingSpot::height).height;
  float next = -std::numeric_limits<float>::infinity();
  std::size_t count = 0;
  for (std::size_t s = 0; s < sky.size(); ++s)
    if (const float height = standing.spots[s].height; top - height <= float(tolerance))
      sky[s] = 1, ++count;
    else
      next = std::max(next, height);
  const double cells = double(standing.grid.columns) * standing.grid.rows;
  const bool alone = count == sky.size();
  if (alone || double(count) < kNearlyAll * cells || top - next < kSkyHeight) std::ranges::fill(sky, 0);
  return sky;
}

std::vector<WalkPlane> collectPlanes(const Standing& standing, const StoreyOptions& options) {
  const double tolerance = options.walkable.floorTolerance;
  const double cellArea = standing.grid.step * standing.grid.step;
  std::vector<WalkPlane> planes;
  std::vector<std::uint8_t> taken = skyOf(standing, tolerance);
  HeightQueue heights(standing, taken, tolerance);
  std::size_t largest = 0;  // spots
  const auto least = [&] {
    return std::max(options.leastArea / cellArea, options.leastShare * double(largest));
  };
  // The span about the median may hold fewer than the fullest span: half as many are worth a look.
  while (static_cast<int>(planes.size()) < kMostPlanes) {
    const auto height = heights.takeFullest(0.5 * least());
    if (!height) break;
    for (WalkPlane& plane :
         planesAt(standing, *height, tolerance, kMostPlanes, static_cast<int>(std::ceil(least())), taken)) {
      largest = std::max(largest, plane.spots.size());
      for (const int spot : plane.spots) taken[std::size_t(spot)] = 1;
      planes.push_back(std::move(plane));
    }
  }
  std::erase_if(planes, [&](const WalkPlane& plane) { return double(plane.spots.size()) < least(); });
  return planes;
}

void sortByHeight(std::vector<WalkPlane>& planes) {
  std::ranges::sort(planes, [](const WalkPlane& a, const WalkPlane& b) {
    return a.height != b.height ? a.height < b.height : a.spots.size() > b.spots.size();
  });
}

/// The floor that a project stands on belongs to the list however small it is beside the others.
void addChosen(std::vector<WalkPlane>& planes, const FloorChoice& floor, double leastArea) {
  if (floor.plane.outline.area() < leastArea) return;
  std::vector<std::uint8_t> chosen(floor.standing.spots.size(), 0);
  for (const int spot : floor.plane.spots) chosen[std::size_t(spot)] = 1;
  const bool listed = std::ranges::any_of(planes, [&](const WalkPlane& plane) {
    return std::ranges::any_of(plane.spots, [&](int spot) { return chosen[std::size_t(spot)] != 0; });
  });
  if (!listed) planes.push_back(floor.plane);
}

/// Tables and podiums: less than head room above a larger plane, and no way up.
void dropFurniture(std::vector<WalkPlane>& planes, const Standing& standing, double headRoom) {
  const std::vector<int> part = numberParts(standing, std::vector<std::uint8_t>(standing.spots.size(), 1));
  const auto partOf = [&](const WalkPlane& plane) { return part[std::size_t(plane.spots.front())]; };
  const std::vector<WalkPlane> all = planes;
  std::erase_if(planes, [&](const WalkPlane& plane) {
    const auto stepsUpFrom = [&](const WalkPlane& other) { return partOf(other) == partOf(plane); };
    const auto towersOver = [&](const WalkPlane& other) {
      return other.spots.size() > plane.spots.size() && plane.height > other.height &&
             plane.height - other.height < headRoom;
    };
    return std::ranges::any_of(all, towersOver) && std::ranges::none_of(all, [&](const WalkPlane& other) {
             return other.spots.size() > plane.spots.size() && stepsUpFrom(other);
           });
  });
}

/// Much of a floor is at one height; of a slice of a ramp or of broad steps, as high as the tolerance lets it
/// be, little is.
bool isLevel(const WalkPlane& plane, const Standing& standing) {
  constexpr float kOneHeight = 0.1F;    // metres
  constexpr double kLeastLevel = 0.36;  // share of its spots; of three steps each has a third
  std::vector<float> heights;
  for (const int spot : plane.spots) heights.push_back(standing.spots[std::size_t(spot)].height);
  std::ranges::sort(heights);
  std::size_t most = 0;
  for (std::size_t k = 0, end = 0; k < heights.size(); ++k) {
    while (end < heights.size() && heights[end] <= heights[k] + kOneHeight) ++end;
    most = std::max(most, end - k);
  }
  return double(most) >= kLeastLevel * double(heights.size());
}

/// Slices of slopes that lead from a level plane to another at a different height: they are the way.
void dropSlopes(std::vector<WalkPlane>& planes, const Standing& standing, double tolerance) {
  std::vector<std::uint8_t> sloped(standing.spots.size(), 0);
  std::vector<int> levelOf(standing.spots.size(), -1);
  for (std::size_t p = 0; p < planes.size(); ++p) {
    const bool level = isLevel(planes[p], standing);
    for (const int spot : planes[p].spots)
      level ? levelOf[std::size_t(spot)] = int(p) : sloped[std::size_t(spot)] = 1;
  }
  // What is of no plane joins slices, and slices and planes.
  for (std::size_t s = 0; s < sloped.size(); ++s) sloped[s] |= levelOf[s] < 0 ? 1 : 0;
  const std::vector<int> part = numberParts(standing, sloped);
  std::map<int, std::pair<double, double>> reach;  // per part: lowest and highest level plane that it touches
  for (std::size_t s = 0; s < part.size(); ++s)
    for (const int next : standing.spots[s].next)
      if (part[s] >= 0 && next >= 0 && levelOf[std::size_t(next)] >= 0) {
        const double height = planes[std::size_t(levelOf[std::size_t(next)])].height;
        auto& [low, high] = reach.emplace(part[s], std::pair{height, height}).first->second;
        low = std::min(low, height), high = std::max(high, height);
      }
  std::erase_if(planes, [&](const WalkPlane& plane) {
    const auto found = reach.find(part[std::size_t(plane.spots.front())]);
    return found != reach.end() && found->second.second - found->second.first > tolerance &&
           plane.height > found->second.first && plane.height < found->second.second;
  });
}

class LinkFinder {
 public:
  LinkFinder(const std::vector<WalkPlane>& planes, const Standing& standing)
      : planes_(planes), standing_(standing), planeOf_(standing.spots.size(), -1) {
    for (std::size_t p = 0; p < planes.size(); ++p)
      for (const int spot : planes[p].spots) planeOf_[std::size_t(spot)] = static_cast<int>(p);
  }

  std::vector<StoreyLink> find() const {
    std::map<std::pair<int, int>, std::vector<Way>> ways;
    for (const auto& [pair, way] : stepsBetween()) ways[pair].push_back(way);
    for (const Stair& stair : stairs())
      for (std::size_t a = 0; a < stair.planes.size(); ++a)
        for (std::size_t b = a + 1; b < stair.planes.size(); ++b)
          ways[{stair.planes[a], stair.planes[b]}].push_back(stair.way);
    std::vector<StoreyLink> links;
    for (auto& [pair, all] : ways) {
      std::ranges::stable_sort(all, std::ranges::greater(), &Way::spots);
      if (all.size() > kMostLinksPerPair) all.resize(kMostLinksPerPair);
      for (const Way& way : all) links.push_back({pair.first, pair.second, way.sum / double(way.spots)});
    }
    return links;
  }

  std::vector<StoreyWay> ways() const {
    std::vector<StoreyWay> ways;
    const glm::dvec2 half(0.5 * standing_.grid.step);
    std::vector<std::uint8_t> seen(planeOf_.size(), 0);
    for (Stair& stair : stairs()) {
      if (stair.planes.size() < 2) continue;
      growIntoPlanes(stair, seen);
      ways.push_back({std::move(stair.planes), stair.way.low - half, stair.way.high + half});
    }
    return ways;
  }

 private:
  struct Way {
    glm::dvec2 sum{0}, low{std::numeric_limits<double>::infinity()}, high{-low};
    std::size_t spots = 0;
    void add(const glm::dvec2& at) {
      sum += at, ++spots;
      low = glm::min(low, at), high = glm::max(high, at);
    }
  };
  struct Stair {
    Way way;
    std::vector<int> spots;
    std::vector<int> planes;  ///< in order
  };

  glm::dvec2 placeOf(std::size_t spot) const {
    return standing_.grid.centreOf(standing_.spots[spot].x, standing_.spots[spot].y);
  }

  /// Planes a step apart.
  std::map<std::pair<int, int>, Way> stepsBetween() const {
    std::map<std::pair<int, int>, Way> steps;
    for (std::size_t s = 0; s < planeOf_.size(); ++s)
      for (const int next : standing_.spots[s].next) {
        if (planeOf_[s] < 0 || next < 0) continue;
        const int other = planeOf_[std::size_t(next)];
        if (other > planeOf_[s]) steps[{planeOf_[s], other}].add(placeOf(s));
      }
    return steps;
  }

  /// Connected spots of no plane, with the planes that they lead to.
  std::vector<Stair> stairs() const {
    std::vector<std::uint8_t> between(planeOf_.size());
    for (std::size_t s = 0; s < planeOf_.size(); ++s) between[s] = planeOf_[s] < 0 ? 1 : 0;
    const std::vector<int> part = numberParts(standing_, between);
    std::vector<Stair> found;
    for (std::size_t s = 0; s < part.size(); ++s) {
      if (part[s] < 0) continue;
      if (std::size_t(part[s]) >= found.size()) found.resize(std::size_t(part[s]) + 1);
      Stair& stair = found[std::size_t(part[s])];
      stair.way.add(placeOf(s));
      stair.spots.push_back(static_cast<int>(s));
      for (const int next : standing_.spots[s].next)
        if (next >= 0 && planeOf_[std::size_t(next)] >= 0)
          stair.planes.push_back(planeOf_[std::size_t(next)]);
    }
    for (Stair& stair : found) {
      std::ranges::sort(stair.planes);
      const auto repeated = std::ranges::unique(stair.planes);
      stair.planes.erase(repeated.begin(), repeated.end());
    }
    return found;
  }

  /// What of the planes is not level yet or no longer belongs to the way, however far that leads.
  void growIntoPlanes(Stair& stair, std::vector<std::uint8_t>& seen) const {
    constexpr double kLevelHeight = 0.04;  // metres
    while (!stair.spots.empty()) {
      const int spot = stair.spots.back();
      stair.spots.pop_back();
      for (const int next : standing_.spots[std::size_t(spot)].next) {
        if (next < 0 || seen[std::size_t(next)] != 0 || planeOf_[std::size_t(next)] < 0) continue;
        const double plane = planes_[std::size_t(planeOf_[std::size_t(next)])].height;
        if (std::abs(double(standing_.spots[std::size_t(next)].height) - plane) <= kLevelHeight) continue;
        seen[std::size_t(next)] = 1;
        stair.spots.push_back(next);
        stair.way.add(placeOf(std::size_t(next)));
      }
    }
  }

  const std::vector<WalkPlane>& planes_;
  const Standing& standing_;
  std::vector<int> planeOf_;  ///< per spot; -1 = none
};

Storeys storeysOf(const FloorChoice& floor, const StoreyOptions& options) {
  const Standing& standing = floor.standing;
  Storeys storeys;
  storeys.planes = collectPlanes(standing, options);
  sortByHeight(storeys.planes);
  dropFurniture(storeys.planes, standing, options.walkable.headRoom());
  dropSlopes(storeys.planes, standing, options.walkable.floorTolerance);
  addChosen(storeys.planes, floor, options.leastArea);
  sortByHeight(storeys.planes);
  const LinkFinder finder(storeys.planes, standing);
  storeys.links = finder.find();
  storeys.ways = finder.ways();
  storeys.ignoredSides = floor.area.ignoredSides;
  return storeys;
}

Result<Storeys> storeysOn(const Bounds& bounds, const ProbeGrid& grid, const WalkableOptions& walkable,
                          const StoreyOptions& options, const SurfaceProbe& probe) {
  const auto floor = chooseFloor(bounds, grid, walkable, probe);
  if (!floor) return tl::unexpected(floor.error());
  return storeysOf(*floor, options);
}

}  // namespace

Status StoreyOptions::check() const {
  if (Status status = walkable.check(); !status) return status;
  if (!(leastShare >= 0 && leastShare <= 1))
    return fail(ErrorKind::invalidArgument, "the least share of a storey's area must lie in 0..1", "storeys");
  if (!(leastArea >= 0 && std::isfinite(leastArea)))
    return fail(ErrorKind::invalidArgument, "the least area of a storey must be 0 m2 or more", "storeys");
  return {};
}

Result<Storeys> findStoreys(const Bounds& bounds, const StoreyOptions& options, const SurfaceProbe& probe) {
  if (Status status = options.check(); !status) return tl::unexpected(status.error());
  const Result<ProbeGrid> grid = layProbeGrid(bounds, options.walkable);
  if (!grid) return tl::unexpected(grid.error());
  WalkableOptions walkable = options.walkable;
  walkable.floorHeight = std::numeric_limits<double>::quiet_NaN();
  auto found = storeysOn(bounds, *grid, walkable, options, probe);
  if (found && found->planes.empty() && !found->ignoredSides) {
    walkable.ignoreSides = true;
    found = storeysOn(bounds, *grid, walkable, options, probe);
  }
  if (!found && found.error().kind != ErrorKind::notFound) return found;
  if (!found || found->planes.empty())
    return fail(ErrorKind::notFound,
                fmt::format("no floor of {:g} m2 has {:.2f} m of room above it; lower the eye height or the "
                            "least area",
                            options.leastArea, options.walkable.headRoom()),
                "storeys");
  return found;
}

}  // namespace acentric
