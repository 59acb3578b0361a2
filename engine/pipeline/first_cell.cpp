#include "engine/pipeline/first_cell.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>

#include "engine/geometry/round_to.h"
#include "engine/inspect/lattice_shift.h"
#include "engine/inspect/surroundings.h"
#include "engine/pipeline/new_project.h"

namespace acentric {
namespace {

/// Rings that a first layout aims at: enough to walk, few enough to bake in minutes.
constexpr double kFirstRings = 12;
constexpr double kSmallestFirstCell = 0.8;
/// A first layout of vast ground has no more: larger cells are chosen instead.
constexpr double kMostFirstRings = 2000;
/// The window that is looked at closely is so many times as wide as the layout could be as a square: streets
/// are a share of the ground.
constexpr double kWindowOverLayout = 3, kLeastWindow = 200, kMostPlacesAcross = 500;
constexpr double kFinestStep = 2;  ///< metres between places looked at, for cells of usual sizes

/// Area of lattice per ring, in units of the squared edge length.
double areaPerRing(Configuration configuration) {
  LayoutSpec unit;
  unit.configuration = configuration;
  unit.cellSize = 1;
  const glm::dvec2 middle = cellPolygon(unit, {0, 0, 0}).centroid();
  const glm::dvec2 along = cellPolygon(unit, {1, 0, 0}).centroid() - middle;
  const glm::dvec2 across = cellPolygon(unit, {0, 1, 0}).centroid() - middle;
  std::set<int> rings;
  for (const LatticeCell& cell : cellsIn(unit, {-4, -4}, {4, 4}, 1000))
    if (cell.kind == RegionKind::ring) rings.insert(cell.id.slot);
  return std::abs(cross(along, across)) / double(std::max<std::size_t>(1, rings.size()));
}

/// Radius of the largest circle about a region's middle.
double roomOf(const ConvexPolygon& polygon) {
  const glm::dvec2 middle = polygon.centroid();
  double room = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const glm::dvec2 &a = polygon.corners[k], &b = polygon.corners[(k + 1) % polygon.size()];
    room = std::min(room, cross(b - a, middle - a) / glm::distance(a, b));
  }
  return room;
}

/// Edge length of rings with so much room.
double cellWithRoom(Configuration configuration, double room) {
  LayoutSpec unit;
  unit.configuration = configuration;
  unit.cellSize = 1;
  return room / roomOf(cellPolygon(unit, {0, 0, 0}));
}

/// Of the grid's places in a polygon.
struct Underfoot {
  int places = 0, floor = 0;
  double clearance = 0;  ///< mean of the floor
};

Underfoot underfoot(const ConvexPolygon& polygon, const NearGround& ground) {
  glm::dvec2 low = polygon.corners.front(), high = low;
  for (const glm::dvec2& corner : polygon.corners) low = glm::min(low, corner), high = glm::max(high, corner);
  const ProbeGrid& grid = ground.grid;
  const auto cellOf = [&](const glm::dvec2& p) { return glm::floor((p - grid.corner) / grid.step); };
  const glm::dvec2 first = cellOf(low), last = cellOf(high);
  Underfoot found;
  for (int y = std::max(0, int(first.y)); y <= std::min(grid.rows - 1, int(last.y)); ++y)
    for (int x = std::max(0, int(first.x)); x <= std::min(grid.columns - 1, int(last.x)); ++x) {
      if (!polygon.containsClosed(grid.centreOf(x, y))) continue;
      ++found.places;
      if (!ground.floor.at(x, y)) continue;
      ++found.floor;
      found.clearance += double(ground.clearance[grid.index(x, y)]);
    }
  if (found.floor > 0) found.clearance /= found.floor;
  return found;
}

class CellChooser {
 public:
  CellChooser(const LayoutSpec& pattern, const NearGround& ground, const CellRules& rules,
              const FreePlace& isFree, const Outline* within)
      : pattern_(pattern), ground_(ground), rules_(rules), isFree_(isFree), within_(within) {}

  void choose(const CellId& id, CellChoice& choice) const {
    const ConvexPolygon polygon = cellPolygon(pattern_, id);
    if (within_ && !within_->overlaps(polygon)) return;
    const Underfoot here = underfoot(polygon, ground_);
    const double room = roomOf(polygon), half = 0.5 * room * (1 + 1e-9);
    const bool divisible = canSplit(pattern_.configuration) && id.level < kMaxLevel;
    const bool narrow = here.floor > 0 && kRoomToSplit * room > here.clearance;
    bool split = divisible && narrow && half >= rules_.usualRoom;
    bool left = here.floor < kLeastFloor * here.places;
    // Between the places that were looked at, floor is not known.
    const bool floor = here.floor > 0 || here.places == 0;
    if (!split && floor && !standsFree(polygon)) {
      split = divisible && half >= rules_.leastRoom;
      left = true;
    }
    if (split) {
      choice.split.insert(id);
      for (const CellId& part : partsOf(pattern_, id)) choose(part, choice);
    } else if (left) {
      choice.removed.insert(id);
    }
  }

 private:
  bool standsFree(const ConvexPolygon& polygon) const {
    const auto blocked = std::ranges::count_if(polygon.corners, std::not_fn(isFree_));
    const auto most = canSplit(pattern_.configuration) ? 0 : std::ptrdiff_t(polygon.size() / 2);
    return blocked <= most && isFree_(polygon.centroid());
  }

  const LayoutSpec& pattern_;
  const NearGround& ground_;
  const CellRules& rules_;
  const FreePlace& isFree_;
  const Outline* within_;
};

/// Sizes from the usual one to kWidest, and places of the lattice each way over a cell of that size.
constexpr int kSizesTried = 4, kPlacesTried = 6;
/// Half as many cameras are worth it if so few of the floor is lost that its share to this power is more than
/// half.
constexpr double kCoverWorth = 3;
/// Of the floor within reach of a place, so many are looked at from it, the nearest first.
constexpr std::size_t kPlacesLookedAt = 8;

std::vector<glm::dvec2> floorNear(const NearGround& ground, const glm::dvec2& place, double reach) {
  const ProbeGrid& grid = ground.grid;
  const glm::dvec2 first = glm::floor((place - reach - grid.corner) / grid.step),
                   last = glm::floor((place + reach - grid.corner) / grid.step);
  std::vector<std::pair<double, glm::dvec2>> near;
  for (int y = std::max(0, int(first.y)); y <= std::min(grid.rows - 1, int(last.y)); ++y)
    for (int x = std::max(0, int(first.x)); x <= std::min(grid.columns - 1, int(last.x)); ++x) {
      const double distance = glm::distance(grid.centreOf(x, y), place);
      if (ground.floor.at(x, y) && distance <= reach) near.emplace_back(distance, grid.centreOf(x, y));
    }
  std::ranges::sort(near, {}, [](const auto& floor) { return floor.first; });
  near.resize(std::min(near.size(), kPlacesLookedAt));
  std::vector<glm::dvec2> places;
  for (const auto& [distance, floor] : near) places.push_back(floor);
  return places;
}

/// Only those that regions of this layout come from.
std::set<CellId> splitsOf(const Layout& layout) {
  std::set<CellId> splits;
  for (const Region& region : layout.regions)
    for (CellId id = region.id; id.level > 0;) {
      id = wholeOf(layout.spec, id);
      splits.insert(id);
    }
  return splits;
}

int leastLevelOf(const Layout& layout) {
  int least = kMaxLevel;
  for (const Region& region : layout.regions) least = std::min(least, region.id.level);
  return layout.regions.empty() ? 0 : least;
}

/// The same layout of cells half as large: no region is whole.
LayoutSpec halved(const LayoutSpec& spec) {
  const auto finer = [](const CellId& id) { return CellId{id.i, id.j, id.slot, id.level - 1}; };
  LayoutSpec half = spec;
  half.cellSize /= 2;
  half.latticeOrigin += cellPolygon(spec, {0, 0, 0, 1}).centroid() - cellPolygon(half, {0, 0, 0}).centroid();
  half.split.clear(), half.removed.clear();
  for (const CellId& id : spec.split)
    if (id.level > 0) half.split.insert(finer(id));
  for (const CellId& id : spec.removed)
    if (id.level > 0)
      half.removed.insert(finer(id));
    else
      for (const CellId& part : partsOf(spec, id)) half.removed.insert(finer(part));
  return half;
}

tl::unexpected<Error> tooFew(std::size_t cameras) {
  return fail(ErrorKind::invalidArgument,
              fmt::format("{} cameras are too few for a single region; allow more (--max-cameras)", cameras));
}

std::optional<std::size_t> camerasOf(const LayoutSpec& spec) {
  const auto layout = buildLayout(spec);
  if (!layout) return std::nullopt;
  return layout->cameras.size();
}

/// Nothing stands about: the same everywhere, with larger cells.
Result<LayoutSpec> enlarged(LayoutSpec spec, std::size_t most) {
  for (;;) {
    const auto cameras = camerasOf(spec);
    if (cameras && *cameras <= most) return spec;
    const double growth = cameras ? std::sqrt(double(*cameras) / double(most)) : 2;
    const double larger = std::ceil(spec.cellSize * std::max(growth, 1.05));
    if (larger > kLargestCellSize) return tooFew(most);
    spec.cellSize = larger;
  }
}

NearGroundOptions lookingFor(const LayoutSpec& spec, const FirstLayoutLimit& limit, bool ignoredSides) {
  NearGroundOptions near;
  near.walkable.eyeHeight = spec.eyeHeight;
  near.walkable.floorHeight = spec.floorHeight;
  near.walkable.ignoreSides = ignoredSides;
  near.around = limit.around;
  const double cell = limit.chooseCell ? cellWithRoom(spec.configuration, kMostRoom) : spec.cellSize;
  // A ring has six cameras or so, whatever the configuration.
  const double rings = std::max(1.0, double(limit.cameras) / 6);
  const double side = cell * std::sqrt(rings * areaPerRing(spec.configuration));
  near.window = std::clamp(kWindowOverLayout * side, kLeastWindow, 1e6);
  near.step = std::max(std::min(kFinestStep, 0.5 * cell), near.window / kMostPlacesAcross);
  return near;
}

}  // namespace

Result<LayoutSpec> withoutIdleChoices(const LayoutSpec& spec) {
  const auto layout = buildLayout(spec);
  if (!layout) return tl::unexpected(layout.error());
  LayoutSpec fewer = spec;
  fewer.split = splitsOf(*layout);
  const auto lies = [&](const CellId& id) {
    return (id.level == 0 || fewer.split.contains(wholeOf(fewer, id))) &&
           fewer.outline.overlaps(cellPolygon(fewer, id));
  };
  for (const CellId& id : spec.split)
    if (!fewer.split.contains(id)) fewer.removed.insert(id);  // no region comes from it
  for (int level = leastLevelOf(*layout); level > 0; --level) fewer = halved(fewer);
  std::erase_if(fewer.removed, [&](const CellId& id) { return !lies(id); });
  return fewer;
}

std::pair<glm::dvec2, glm::dvec2> extentOf(const Outline& outline) {
  glm::dvec2 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const auto& loop : outline.loops)
    for (const glm::dvec2& corner : loop) low = glm::min(low, corner), high = glm::max(high, corner);
  return {low, high};
}

double firstCellSize(double walkableSquareMetres, Configuration configuration) {
  const double perRing = areaPerRing(configuration);
  const double middling = std::sqrt(walkableSquareMetres / (kFirstRings * perRing));
  const double coarse = std::sqrt(walkableSquareMetres / (kMostFirstRings * perRing));
  if (coarse > kLargestUsualCell) return std::min(std::ceil(coarse), kLargestCellSize);
  return std::clamp(roundTo(middling, 0.05), kSmallestFirstCell, kLargestUsualCell);
}

bool exceeds(const LayoutSpec& spec, const FirstLayoutLimit& limit) {
  if (limit.cameras == 0) return false;
  const double rings =
      spec.outline.area() / (areaPerRing(spec.configuration) * spec.cellSize * spec.cellSize);
  if (rings > double(limit.cameras)) return true;  // and so many more cameras
  const auto cameras = camerasOf(spec);
  return cameras && *cameras > limit.cameras;
}

FreePlace freePlaces(const NearGround& ground, double eyeZ, double reach, const SurfaceProbe& probe) {
  const auto look = [&ground, eyeZ, reach, &probe](const glm::dvec2& place) {
    const glm::dvec3 eye(place, eyeZ);
    const auto sees = [&](const glm::dvec2& floor) {
      const glm::dvec2 way = floor - place;
      const double distance = glm::length(way);
      return !(distance > 0) || !(probe(eye, glm::dvec3(way / distance, 0)).distance < distance);
    };
    return std::ranges::any_of(floorNear(ground, place, reach), sees) && hasRoom(eye, kCameraRoom, probe);
  };
  using Known = std::map<std::pair<long long, long long>, bool>;
  return [look, known = std::make_shared<Known>()](const glm::dvec2& place) {
    const auto key = std::pair(std::llround(place.x * 1e4), std::llround(place.y * 1e4));
    const auto found = known->find(key);
    return found != known->end() ? found->second : known->emplace(key, look(place)).first->second;
  };
}

CellChoice chooseCells(const LayoutSpec& pattern, const NearGround& ground, const CellRules& rules,
                       const FreePlace& isFree, const Outline* within) {
  CellChoice choice;
  LayoutSpec whole = pattern;
  whole.split.clear();
  const CellChooser chooser(whole, ground, rules, isFree, within);
  const ProbeGrid& grid = ground.grid;
  auto [low, high] = std::pair(grid.corner, grid.corner + grid.step * glm::dvec2(grid.columns, grid.rows));
  if (within) {
    const auto [first, last] = extentOf(*within);
    low = glm::max(low, first), high = glm::min(high, last);
  }
  for (const LatticeCell& cell : cellsIn(whole, low, high, kMaxRegions)) chooser.choose(cell.id, choice);
  return choice;
}

FittedCells fitCells(const LayoutSpec& pattern, const NearGround& ground, const CellRules& rules,
                     const FreePlace& isFree, double size, int steps) {
  const ProbeGrid& grid = ground.grid;
  std::vector<glm::dvec2> floor;
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x) {
      const glm::dvec2 place = grid.centreOf(x, y);
      if (ground.floor.at(x, y) && pattern.outline.contains(place)) floor.push_back(place);
    }
  FittedCells best{pattern, 0};
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      LayoutSpec there = pattern;
      const glm::dvec2 to = pattern.latticeOrigin + size / steps * glm::dvec2(i, j);
      there.latticeOrigin = glm::round(to * 100.0) / 100.0;
      CellChoice cells = chooseCells(there, ground, rules, isFree, &pattern.outline);
      there.split = std::move(cells.split), there.removed = std::move(cells.removed);
      const auto layout = buildLayout(there);
      if (!layout || layout->cameras.empty()) continue;
      const auto served = std::ranges::count_if(
          floor, [&](const glm::dvec2& place) { return layout->regionAt(place).has_value(); });
      const double share = floor.empty() ? 0 : double(served) / double(floor.size());
      const double worth = std::pow(share, kCoverWorth) / double(layout->cameras.size());
      if (worth > best.worth * (1 + 1e-9)) best = {std::move(there), worth};
    }
  return best;
}

namespace {

struct ServedPart {
  Outline outline;
  std::size_t cameras = 0;
};

/// Of the ground within so long a way, what regions of the pattern's layout serve.
std::optional<ServedPart> servedPart(const LayoutSpec& pattern, const NearGround& ground, double way) {
  CellMask part = partWithin(ground, way);
  LayoutSpec spec = pattern;
  spec.outline = tidied(outlineAround(part, ground.grid));
  auto layout = buildLayout(spec);
  if (!layout) return std::nullopt;
  if (pattern.removed.empty()) return ServedPart{std::move(spec.outline), layout->cameras.size()};
  for (int y = 0; y < part.rows; ++y)
    for (int x = 0; x < part.columns; ++x)
      if (part.at(x, y) && !layout->regionAt(ground.grid.centreOf(x, y))) part.cells[part.index(x, y)] = 0;
  part = largestClearPart(part, ground.links);
  if (part.count() == 0) return ServedPart{};
  spec.outline = tidied(outlineAround(part, ground.grid));
  layout = buildLayout(spec);
  if (!layout) return std::nullopt;
  return ServedPart{std::move(spec.outline), layout->cameras.size()};
}

}  // namespace

std::optional<Outline> largestOutline(const LayoutSpec& pattern, const NearGround& ground,
                                      std::size_t mostCameras) {
  std::vector<float> ways;
  for (const float way : ground.wayTo)
    if (std::isfinite(way)) ways.push_back(way);
  std::ranges::sort(ways);
  // More floor than so has more rings than cameras may be, though each has several.
  const double ring = areaPerRing(pattern.configuration) * pattern.cellSize * pattern.cellSize;
  const double most = 0.25 * double(mostCameras) * ring / (ground.grid.step * ground.grid.step) + 1;
  if (double(ways.size()) > most) ways.resize(std::size_t(most));
  std::optional<Outline> best;
  std::size_t low = 0, high = ways.size();  // as many cells as low fit, more than high do not
  while (low < high) {
    const std::size_t count = low + (high - low + 1) / 2;
    const auto part = servedPart(pattern, ground, double(ways[count - 1]));
    if (part && part->cameras <= mostCameras)
      best = part->outline, low = count;
    else
      high = count - 1;
  }
  return best;
}

Result<LayoutSpec> keepWithin(const LayoutSpec& spec, const FirstLayoutLimit& limit, const Bounds& bounds,
                              bool ignoredSides, const SurfaceProbe& probe, std::stop_token stop) {
  LayoutSpec kept = spec;
  if (limit.chooseConfiguration && limit.chooseCell) kept.configuration = Configuration::e;
  NearGroundOptions near = lookingFor(kept, limit, ignoredSides);
  Bounds about = bounds;  // other floor at this height lies elsewhere
  const auto [low, high] = extentOf(spec.outline);
  about.min = glm::max(about.min, glm::vec3(glm::vec2(low), about.min.z));
  about.max = glm::min(about.max, glm::vec3(glm::vec2(high), about.max.z));
  auto ground = surveyNearGround(about, near, probe);
  if (!ground && ground.error().kind == ErrorKind::notFound && !limit.around) {
    if (limit.chooseCell) return enlarged(spec, limit.cameras);
    near.around = spec.latticeOrigin;
    ground = surveyNearGround(about, near, probe);
  }
  if (!ground) return tl::unexpected(ground.error());
  const double room = std::clamp(middleClearance(*ground, kGroundToMeasure), kLeastRoom, kMostRoom);
  if (limit.chooseCell) kept.cellSize = roundTo(cellWithRoom(kept.configuration, room), 0.05);
  kept.latticeOrigin = glm::round(ground->startPlace() * 100.0) / 100.0;
  auto outline = largestOutline(kept, *ground, limit.cameras);
  if (!outline) return tooFew(limit.cameras);
  kept.outline = std::move(*outline);
  const double eyeZ = kept.floorHeight + kept.eyeHeight;
  const double reach = 2 * cellWithRoom(kept.configuration, kMostRoom);
  const FreePlace isFree = freePlaces(*ground, eyeZ, reach, probe);
  CellRules rules{kept.cellSize, kept.cellSize};  // none is split
  if (limit.chooseCell && canSplit(kept.configuration)) {
    const LayoutSpec usual = kept;
    double most = 0;
    for (int size = 0; size < kSizesTried; ++size) {
      const double times = std::lerp(1.0, kWidest, double(size) / (kSizesTried - 1));
      LayoutSpec pattern = usual;
      pattern.cellSize = roundTo(cellWithRoom(usual.configuration, kLargestOverUsual * times * room), 0.05);
      const CellRules these{times * room, kLeastOverUsual * times * room};
      const FittedCells fitted =
          fitCells(pattern, *ground, these, isFree, times * usual.cellSize, kPlacesTried);
      if (fitted.worth > most) most = fitted.worth, kept = fitted.spec, rules = these;
    }
  } else {
    ShiftOptions shift;
    shift.crowding.trustSides = !ignoredSides;
    kept.latticeOrigin = findFreestOrigin(kept, shift, probe, stop).origin;
  }
  CellChoice cells = chooseCells(kept, *ground, rules, isFree);
  kept.split = std::move(cells.split), kept.removed = std::move(cells.removed);
  outline = largestOutline(kept, *ground, limit.cameras);  // as the cells are now, others fit it
  if (!outline || outline->empty()) return tooFew(limit.cameras);
  kept.outline = std::move(*outline);
  return withoutIdleChoices(kept);
}

}  // namespace acentric
