#include "engine/inspect/lattice_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "engine/geometry/round_to.h"
#include "engine/inspect/cell_mask.h"
#include "engine/inspect/floor_levels.h"

namespace acentric {
namespace {

/// Between places of the outline that are looked at: so many of a cell's edge, and no narrower than a
/// passage.
constexpr double kStepsOfCell = 8, kPassage = 0.4;
constexpr int kMostStepsAcross = 150;
/// But never more than so far apart, in cells' edges; where that takes more than this many, cells are left
/// out of the best lattice alone, and none of ground that would take more than the last.
constexpr double kWidestStep = 0.25, kFewPlaces = 3e4, kMostPlaces = 4e6;
/// Places looked at to see whether the floor stays in one piece, all in all.
constexpr double kMostLooks = 4e8;
/// Half as many cameras are worth it if so few of the floor is lost that its share to this power is more than
/// half.
constexpr double kServedWorth = 3;
constexpr double kTurnWorth = 0.95;    // of the cost at the spec's own rotation
constexpr double kLeastAligned = 0.3;  // of the walls: else they have no common way
constexpr double kTurnAccuracy = 0.5;  // degrees

/// Lowest and highest corner of the box around an outline.
std::pair<glm::dvec2, glm::dvec2> boxAround(const Outline& outline) {
  glm::dvec2 low = outline.loops.front().front(), high = low;
  for (const auto& loop : outline.loops)
    for (const glm::dvec2& corner : loop) low = glm::min(low, corner), high = glm::max(high, corner);
  return {low, high};
}

/// The outline's inside, in square cells.
struct Floor {
  ProbeGrid grid;
  CellMask mask;

  Floor(const Outline& outline, double cellSize) {
    const auto [low, high] = boxAround(outline);
    const double across = std::max(high.x - low.x, high.y - low.y);
    grid.corner = low;
    grid.step = std::min(std::max(std::min(cellSize / kStepsOfCell, kPassage), across / kMostStepsAcross),
                         kWidestStep * cellSize);
    if (!((high.x - low.x) * (high.y - low.y) < kMostPlaces * grid.step * grid.step)) return;
    grid.columns = int(std::ceil((high.x - low.x) / grid.step)) + 1;
    grid.rows = int(std::ceil((high.y - low.y) / grid.step)) + 1;
    mask = CellMask(grid.columns, grid.rows);
    for (int y = 0; y < grid.rows; ++y)
      for (int x = 0; x < grid.columns; ++x)
        mask.cells[mask.index(x, y)] = outline.contains(grid.centreOf(x, y)) ? 1 : 0;
  }
};

/// How many pieces, joined by sides, a mask has.
int piecesOf(CellMask mask) {
  int pieces = 0;
  std::vector<glm::ivec2> open;
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.columns; ++x) {
      const auto take = [&](int i, int j) {
        if (!mask.at(i, j)) return;
        mask.cells[mask.index(i, j)] = 0;
        open.emplace_back(i, j);
      };
      if (mask.at(x, y)) ++pieces;
      take(x, y);
      while (!open.empty()) {
        const glm::ivec2 at = open.back();
        open.pop_back();
        take(at.x + 1, at.y), take(at.x - 1, at.y), take(at.x, at.y + 1), take(at.x, at.y - 1);
      }
    }
  return pieces;
}

/// Leaves out cells of a layout that have little floor; says which share of the floor the others have.
double leaveOutBare(LayoutSpec& spec, const Layout& layout, const Floor& floor, double mostLost) {
  std::vector<std::vector<std::size_t>> of(layout.regions.size());  // of the mask's cells
  CellMask served(floor.mask.columns, floor.mask.rows);
  for (int y = 0; y < served.rows; ++y)
    for (int x = 0; x < served.columns; ++x) {
      if (!floor.mask.at(x, y)) continue;
      const auto region = layout.regionAt(floor.grid.centreOf(x, y));
      if (!region) continue;
      served.cells[served.index(x, y)] = 1;
      of[std::size_t(*region)].push_back(served.index(x, y));
    }
  const double all = double(std::max<std::size_t>(1, floor.mask.count()));
  double has = double(served.count());
  const double least = has - mostLost * all;
  std::vector<std::size_t> bare;
  for (std::size_t r = 0; r < of.size(); ++r)
    if (double(of[r].size()) * floor.grid.step * floor.grid.step <
        kLeastFloor * layout.regions[r].polygon.area())
      bare.push_back(r);
  std::ranges::stable_sort(bare, {}, [&](std::size_t r) { return of[r].size(); });
  int pieces = piecesOf(served);
  double looks = kMostLooks / double(served.cells.size());
  for (const std::size_t r : bare) {
    if (looks-- < 0 || has - double(of[r].size()) < least || spec.removed.size() + 1 == layout.regions.size())
      break;
    CellMask without = served;
    for (const std::size_t cell : of[r]) without.cells[cell] = 0;
    const int left = piecesOf(without);
    if (left > pieces) continue;
    served = std::move(without), pieces = left, has -= double(of[r].size());
    spec.removed.insert(layout.regions[r].id);
  }
  return has / all;
}

/// The way along most of the outline's walls, or across it: radians in [0, pi/2); nothing if they have none
/// in common.
std::optional<double> wayOfWalls(const Outline& outline) {
  std::complex<double> sum;
  double length = 0;
  for (const auto& loop : outline.loops)
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const glm::dvec2 wall = loop[(k + 1) % loop.size()] - loop[k];
      sum += std::polar(glm::length(wall), 4 * std::atan2(wall.y, wall.x));
      length += glm::length(wall);
    }
  if (!(std::abs(sum) > kLeastAligned * length)) return std::nullopt;
  return wrapAngle(std::arg(sum)) / 4;
}

/// Rotations worth trying beside the spec's own, radians: lattices of hexagons and triangles look alike
/// across a way after a twelfth of a turn.
std::vector<double> turnsFor(const LayoutSpec& spec) {
  std::vector<double> turns{spec.rotationRadians};
  const bool ofSix = cellPolygon(spec, {0, 0, 0}).size() % 3 == 0;
  const double period = kTwoPi / (ofSix ? 6 : 4);
  const auto add = [&](double turn) {
    // Of whole halves of degrees, which project files hold exactly; along the walls or across them for
    // lattices of all kinds.
    const double tidy = radians(roundTo(degrees(turn), kTurnAccuracy));
    const auto alike = [&](double other) {
      const double apart = std::abs(std::remainder(tidy - other, period));
      return apart < radians(2 * kTurnAccuracy);
    };
    if (std::ranges::none_of(turns, alike)) turns.push_back(tidy);
  };
  if (const auto way = wayOfWalls(spec.outline)) {
    add(*way);
    add(*way + kTwoPi / 4);
  }
  return turns;
}

}  // namespace

LatticeFit fitLattice(const LayoutSpec& spec, const LatticeFitOptions& options, const SurfaceProbe& probe,
                      std::stop_token stop) {
  LayoutSpec own = spec;
  own.forgetCells();
  LatticeFit best{spec, 0};
  if (spec.outline.empty()) return best;
  const Floor floor(spec.outline, spec.cellSize);
  const std::size_t places = floor.mask.cells.size();
  const bool few = places > 0 && double(places) <= kFewPlaces;
  const auto first = buildLayout(own);
  if (!first || first->regions.empty()) return best;
  const std::vector<double> turns = turnsFor(own);
  const double affordable = double(options.shift.mostCameras) / double(first->cameras.size() * turns.size());
  const int steps = std::max(1, std::min(options.shift.steps, int(std::sqrt(affordable))));
  double least = std::numeric_limits<double>::infinity();
  const auto attempt = [&](LayoutSpec tried, double worth) {
    const auto whole = buildLayout(tried);
    if (!whole || whole->regions.empty()) return;
    const double served = few ? leaveOutBare(tried, *whole, floor, options.mostLost) : 1;
    const auto layout = tried.removed.empty() ? whole : buildLayout(tried);
    if (!layout || layout->regions.empty() || !(served > 0)) return;
    const double cost = (double(layout->cameras.size()) + crowding(*layout, options.shift.crowding, probe)) /
                        std::pow(served, kServedWorth) / worth;
    if (cost < least * (1 - 1e-9)) least = cost, best = {std::move(tried), served};
  };
  // Whatever the lattice is now, the same places are tried: fitted again, it stays.
  const auto tidy = [rounding = options.shift.rounding](const glm::dvec2& origin) {
    return glm::dvec2(roundTo(origin.x, rounding), roundTo(origin.y, rounding));
  };
  const auto [low, high] = boxAround(spec.outline);
  const glm::dvec2 corner = tidy(0.5 * (low + high));
  if (!stop.stop_requested()) attempt(own, 1);
  for (const double turn : turns) {
    LayoutSpec turned = own;
    turned.rotationRadians = turn;
    const glm::dvec2 middle = cellPolygon(turned, {0, 0, 0}).centroid();
    const glm::dvec2 along = cellPolygon(turned, {1, 0, 0}).centroid() - middle;
    const glm::dvec2 across = cellPolygon(turned, {0, 1, 0}).centroid() - middle;
    for (int i = 0; i < steps; ++i)
      for (int j = 0; j < steps; ++j) {
        if (stop.stop_requested()) return best;
        turned.latticeOrigin = tidy(corner + (along * double(i) + across * double(j)) / double(steps));
        attempt(turned, turn == own.rotationRadians ? 1 : kTurnWorth);
      }
  }
  if (!few && places > 0)
    if (const auto whole = buildLayout(best.spec))
      best.served = leaveOutBare(best.spec, *whole, floor, options.mostLost);
  return best;
}

}  // namespace acentric
