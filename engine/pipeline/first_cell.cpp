#include "engine/pipeline/first_cell.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/inspect/lattice_shift.h"
#include "engine/pipeline/pipeline.h"

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

double roundTo(double value, double step) { return std::round(value / step) * step; }

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

void addSplits(const LayoutSpec& pattern, const CellId& id, const NearGround& ground, double leastRoom,
               CellChoice& choice) {
  const ConvexPolygon polygon = cellPolygon(pattern, id);
  const double room = roomOf(polygon);
  const Underfoot here = underfoot(polygon, ground);
  const bool divisible =
      canSplit(pattern.configuration) && id.level < kMaxLevel && 0.5 * room >= leastRoom * (1 - 1e-9);
  if (divisible && here.floor > 0 && kRoomToSplit * room > here.clearance) {
    choice.split.insert(id);
    for (const CellId& part : partsOf(pattern, id)) addSplits(pattern, part, ground, leastRoom, choice);
  } else if (here.places > 0 && here.floor < kLeastFloor * here.places) {
    choice.removed.insert(id);
  }
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

/// The same without splits and removals that change nothing of the layout. Where leaving them out would
/// change it (a cell that was split into parts outside becomes a region), they stay.
Result<LayoutSpec> withoutIdleChoices(const LayoutSpec& spec) {
  const auto layout = buildLayout(spec);
  if (!layout) return tl::unexpected(layout.error());
  LayoutSpec fewer = spec;
  fewer.split = splitsOf(*layout);
  std::erase_if(fewer.removed, [&](const CellId& id) {
    const bool lies = id.level == 0 || fewer.split.contains(wholeOf(fewer, id));
    return !lies || !fewer.outline.overlaps(cellPolygon(fewer, id));
  });
  const auto same = buildLayout(fewer);
  const auto ids = [](const Layout& of) {
    std::vector<CellId> all;
    for (const Region& region : of.regions) all.push_back(region.id);
    return all;
  };
  return same && ids(*same) == ids(*layout) ? fewer : spec;
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

CellChoice chooseCells(const LayoutSpec& pattern, const NearGround& ground, double leastRoom) {
  CellChoice choice;
  LayoutSpec whole = pattern;
  whole.split.clear();
  const ProbeGrid& grid = ground.grid;
  const glm::dvec2 size = grid.step * glm::dvec2(grid.columns, grid.rows);
  for (const LatticeCell& cell : cellsIn(whole, grid.corner, grid.corner + size, kMaxRegions))
    addSplits(whole, cell.id, ground, leastRoom, choice);
  return choice;
}

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
  LayoutSpec spec = pattern;
  while (low < high) {
    const std::size_t count = low + (high - low + 1) / 2;
    spec.outline = tidied(outlineAround(partWithin(ground, double(ways[count - 1])), ground.grid));
    const auto cameras = camerasOf(spec);
    if (cameras && *cameras <= mostCameras)
      best = spec.outline, low = count;
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
  ShiftOptions shift;
  shift.crowding.trustSides = !ignoredSides;
  kept.latticeOrigin = findFreestOrigin(kept, shift, probe, stop).origin;
  if (limit.chooseCell) {
    if (canSplit(kept.configuration))
      kept.cellSize = roundTo(cellWithRoom(kept.configuration, 2 * room), 0.05);
    CellChoice cells = chooseCells(kept, *ground, room);
    kept.split = std::move(cells.split), kept.removed = std::move(cells.removed);
  }
  outline = largestOutline(kept, *ground, limit.cameras);  // as the cells are now, others fit it
  if (!outline) return tooFew(limit.cameras);
  kept.outline = std::move(*outline);
  return withoutIdleChoices(kept);
}

}  // namespace acentric
