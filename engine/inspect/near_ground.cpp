#include "engine/inspect/near_ground.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "engine/base/contract.h"
#include "engine/inspect/floor_choice.h"

namespace acentric {
namespace {

constexpr double kEnclosedSquare = 150;  // metres: where a walk begins, most floor is enclosed
constexpr double kLeastEnclosed = 0.05;  // mean enclosure of a place where something stands about
constexpr double kFarthestStep = 180;    // metres between places that still tell what stands about them
constexpr float kNoWay = std::numeric_limits<float>::infinity();

Bounds windowOf(const Bounds& bounds, const glm::dvec2& middle, double side) {
  Bounds window = bounds;
  const glm::vec2 low(middle - 0.5 * side), high(middle + 0.5 * side);
  window.min = glm::max(window.min, glm::vec3(low, window.min.z));
  window.max = glm::min(window.max, glm::vec3(high, window.max.z));
  return window;
}

/// Sums over rectangles of cells.
class AreaSums {
 public:
  AreaSums(int columns, int rows, const std::vector<double>& values)
      : columns_(columns), rows_(rows), sums_(std::size_t(columns + 1) * std::size_t(rows + 1), 0) {
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x)
        sums_[at(x + 1, y + 1)] = values[std::size_t(y) * std::size_t(columns) + std::size_t(x)] +
                                  sums_[at(x, y + 1)] + sums_[at(x + 1, y)] - sums_[at(x, y)];
  }
  double around(int x, int y, int reach) const {
    const int x0 = std::max(x - reach, 0), y0 = std::max(y - reach, 0);
    const int x1 = std::min(x + reach + 1, columns_), y1 = std::min(y + reach + 1, rows_);
    return sums_[at(x1, y1)] - sums_[at(x0, y1)] - sums_[at(x1, y0)] + sums_[at(x0, y0)];
  }

 private:
  std::size_t at(int x, int y) const { return std::size_t(y) * std::size_t(columns_ + 1) + std::size_t(x); }
  int columns_, rows_;
  std::vector<double> sums_;
};

/// The floor of a choice as cells, with what was felt about each.
NearGround groundOf(const FloorChoice& choice) {
  NearGround ground;
  const Standing& standing = choice.standing;
  ground.grid = standing.grid;
  ground.floor = CellMask(ground.grid.columns, ground.grid.rows);
  const std::size_t cells = ground.floor.cells.size();
  std::vector<int> spotOf(cells, -1);
  ground.clearance.assign(cells, float(kOpenClearance));
  for (const int s : choice.plane.spots) {
    const StandingSpot& spot = standing.spots[std::size_t(s)];
    const std::size_t cell = ground.grid.index(spot.x, spot.y);
    ground.floor.cells[cell] = 1;
    spotOf[cell] = s;
    ground.clearance[cell] = std::min(spot.clearance, float(kOpenClearance));
  }
  ground.links.right.assign(cells, 0), ground.links.up.assign(cells, 0);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    if (spotOf[cell] < 0) continue;
    const StandingSpot& spot = standing.spots[std::size_t(spotOf[cell])];
    const auto linked = [&](std::size_t side, std::size_t next) {
      return std::uint8_t(spotOf[next] >= 0 && spot.next[side] == spotOf[next] ? 1 : 0);
    };
    if (spot.x + 1 < ground.grid.columns) ground.links.right[cell] = linked(0, cell + 1);
    if (spot.y + 1 < ground.grid.rows)
      ground.links.up[cell] = linked(1, cell + std::size_t(ground.grid.columns));
  }
  spreadClearance(ground.clearance, ground.grid);
  return ground;
}

int nearestCell(const NearGround& ground, const glm::dvec2& place) {
  int nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (int y = 0; y < ground.grid.rows; ++y)
    for (int x = 0; x < ground.grid.columns; ++x) {
      if (!ground.floor.at(x, y)) continue;
      const double distance = glm::distance(ground.grid.centreOf(x, y), place);
      if (distance < least) least = distance, nearest = int(ground.grid.index(x, y));
    }
  return nearest;
}

}  // namespace

Status NearGroundOptions::check() const {
  if (Status sound = walkable.check(); !sound) return sound;
  const auto refuse = [](std::string message) {
    return fail(ErrorKind::invalidArgument, std::move(message), "near ground");
  };
  if (std::isnan(walkable.floorHeight)) return refuse("the height of the floor must be given");
  if (!(window > 0 && window <= 1e6)) return refuse("the window must lie in (0, 1e6] metres");
  if (!(step > 0 && step <= window && window / step <= 2000))
    return refuse("the step must lie between a 2000th of the window and the window");
  if (around && !(std::isfinite(around->x) && std::isfinite(around->y)))
    return refuse("the place to begin must be finite");
  return {};
}

double wayCost(double clearance) {
  if (clearance < kGapClearance) return 3 - 2 * std::max(0.0, clearance) / kGapClearance;
  return std::max(1.0, std::min(clearance, kOpenClearance) / kStreetClearance);
}

glm::dvec2 NearGround::startPlace() const {
  return grid.centreOf(start % grid.columns, start / grid.columns);
}

int startNear(const NearGround& ground, const glm::dvec2& place, double reach) {
  const ProbeGrid& grid = ground.grid;
  const auto isMiddle = [&](int x, int y) {
    const float here = ground.clearance[grid.index(x, y)];
    if (double(here) > kStreetClearance) return false;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (ground.floor.at(x + dx, y + dy) && ground.clearance[grid.index(x + dx, y + dy)] > here)
          return false;
    return true;
  };
  int best = -1;
  double room = 0, away = 0;
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x) {
      const double distance = glm::distance(grid.centreOf(x, y), place);
      if (distance > reach || !ground.floor.at(x, y) || !isMiddle(x, y)) continue;
      const int cell = int(grid.index(x, y));
      // To the step of the grid: what is felt is no more exact.
      const double here = std::round(double(ground.clearance[std::size_t(cell)]) / grid.step);
      if (best >= 0 && (here < room || (here == room && distance >= away))) continue;
      best = cell, room = here, away = distance;
    }
  return best >= 0 ? best : nearestCell(ground, place);
}

std::optional<glm::dvec2> mostEnclosedPlace(const Standing& standing) {
  const ProbeGrid& grid = standing.grid;
  if (standing.spots.empty() || grid.step > kFarthestStep) return std::nullopt;
  std::vector<double> enclosed(std::size_t(grid.columns) * std::size_t(grid.rows), 0), spots = enclosed;
  for (const StandingSpot& spot : standing.spots) {
    enclosed[grid.index(spot.x, spot.y)] += double(spot.enclosure);
    spots[grid.index(spot.x, spot.y)] += 1;
  }
  const AreaSums enclosure(grid.columns, grid.rows, enclosed), count(grid.columns, grid.rows, spots);
  const int reach = std::max(0, int(std::round(0.5 * kEnclosedSquare / grid.step)));
  double most = 0;
  std::optional<glm::dvec2> best;
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x) {
      const double here = enclosure.around(x, y, reach);
      if (here <= most || here < kLeastEnclosed * count.around(x, y, reach)) continue;
      most = here;
      best = grid.centreOf(x, y);
    }
  return best;
}

void spreadClearance(std::vector<float>& felt, const ProbeGrid& grid) {
  // Two sweeps are exact for steps along rows, columns and diagonals (a chamfer distance).
  const float straight = float(grid.step), diagonal = float(grid.step * std::sqrt(2.0));
  const auto lower = [&](int x, int y, int dx, int dy) {
    const int nx = x + dx, ny = y + dy;
    if (nx < 0 || ny < 0 || nx >= grid.columns || ny >= grid.rows) return;
    float& here = felt[grid.index(x, y)];
    here = std::min(here, felt[grid.index(nx, ny)] + (dx != 0 && dy != 0 ? diagonal : straight));
  };
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x)
      lower(x, y, -1, 0), lower(x, y, -1, -1), lower(x, y, 0, -1), lower(x, y, 1, -1);
  for (int y = grid.rows; y-- > 0;)
    for (int x = grid.columns; x-- > 0;)
      lower(x, y, 1, 0), lower(x, y, 1, 1), lower(x, y, 0, 1), lower(x, y, -1, 1);
}

std::vector<float> waysFrom(int start, const ProbeGrid& grid, const CellMask& floor, const CellLinks& links,
                            const std::vector<float>& clearance) {
  std::vector<float> way(floor.cells.size(), kNoWay);
  using Reached = std::pair<float, int>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  way[std::size_t(start)] = 0;
  open.emplace(0.0f, start);
  const auto right = [&](int x, int y) {
    return floor.at(x, y) && floor.at(x + 1, y) && links.right[grid.index(x, y)] != 0;
  };
  const auto up = [&](int x, int y) {
    return floor.at(x, y) && floor.at(x, y + 1) && links.up[grid.index(x, y)] != 0;
  };
  const auto across = [&](int x, int y, int dx) { return dx > 0 ? right(x, y) : right(x - 1, y); };
  const auto along = [&](int x, int y, int dy) { return dy > 0 ? up(x, y) : up(x, y - 1); };
  while (!open.empty()) {
    const auto [so_far, cell] = open.top();
    open.pop();
    if (so_far > way[std::size_t(cell)]) continue;
    const int x = cell % grid.columns, y = cell / grid.columns;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        bool linked = false;
        if (dx != 0 && dy == 0) linked = across(x, y, dx);
        if (dx == 0 && dy != 0) linked = along(x, y, dy);
        if (dx != 0 && dy != 0)
          linked = across(x, y, dx) && along(x + dx, y, dy) && along(x, y, dy) && across(x, y + dy, dx);
        if (!linked) continue;
        const std::size_t next = grid.index(x + dx, y + dy);
        const double cost =
            0.5 * (wayCost(double(clearance[std::size_t(cell)])) + wayCost(double(clearance[next])));
        const float then = so_far + float(grid.step * (dx != 0 && dy != 0 ? std::sqrt(2.0) : 1.0) * cost);
        if (then < way[next]) way[next] = then, open.emplace(then, int(next));
      }
  }
  return way;
}

Result<NearGround> surveyNearGround(const Bounds& bounds, const NearGroundOptions& options,
                                    const SurfaceProbe& probe) {
  if (Status sound = options.check(); !sound) return tl::unexpected(sound.error());
  WalkableOptions walkable = options.walkable;
  std::optional<glm::dvec2> around = options.around;
  const auto surveyOf = [&](const Bounds& part) -> Result<FloorChoice> {
    const auto grid = layProbeGrid(part, walkable);
    if (!grid) return tl::unexpected(grid.error());
    return chooseFloor(part, *grid, walkable, probe);
  };
  if (!around) {
    walkable.gridStep = 0;
    const auto all = surveyOf(bounds);
    if (!all) return tl::unexpected(all.error());
    around = mostEnclosedPlace(all->standing);
    if (!around)
      return fail(ErrorKind::notFound, "nothing stands about anywhere on this ground", "near ground");
  }
  const Bounds window = windowOf(bounds, *around, options.window);
  if (window.empty() || !(window.min.x < window.max.x && window.min.y < window.max.y))
    return fail(ErrorKind::notFound, fmt::format("({:g}, {:g}) lies outside the scene", around->x, around->y),
                "near ground");
  walkable.gridStep = options.step;
  const auto floor = surveyOf(window);
  if (!floor) return tl::unexpected(floor.error());
  NearGround ground = groundOf(*floor);
  ground.start =
      options.around ? nearestCell(ground, *around) : startNear(ground, *around, 0.5 * kEnclosedSquare);
  require(ground.start >= 0, "a floor has cells");
  ground.wayTo = waysFrom(ground.start, ground.grid, ground.floor, ground.links, ground.clearance);
  return ground;
}

double middleClearance(const NearGround& ground, double squareMetres) {
  std::vector<std::pair<float, float>> cells;  // way, clearance
  for (std::size_t cell = 0; cell < ground.wayTo.size(); ++cell)
    if (ground.wayTo[cell] < kNoWay) cells.emplace_back(ground.wayTo[cell], ground.clearance[cell]);
  require(!cells.empty(), "the start is reached");
  std::ranges::sort(cells);
  const double wanted =
      std::clamp(squareMetres / (ground.grid.step * ground.grid.step), 1.0, double(cells.size()));
  cells.resize(std::size_t(wanted));
  const auto middle = cells.begin() + std::ptrdiff_t(cells.size() / 2);
  std::ranges::nth_element(cells, middle, {}, [](const auto& cell) { return cell.second; });
  return double(middle->second);
}

CellMask partWithin(const NearGround& ground, double way) {
  CellMask part(ground.grid.columns, ground.grid.rows);
  for (std::size_t cell = 0; cell < part.cells.size(); ++cell)
    part.cells[cell] = double(ground.wayTo[cell]) <= way ? 1 : 0;
  part.cells[std::size_t(ground.start)] = 1;
  return largestClearPart(part, ground.links);
}

}  // namespace acentric
