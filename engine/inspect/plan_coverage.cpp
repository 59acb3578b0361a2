#include "engine/inspect/plan_coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/geometry/conventions.h"
#include "engine/geometry/predicates/orientation.h"

namespace acentric {
namespace {

constexpr double kMostPoints = 1 << 26;

/// Cells [first, last) of a row.
struct Span {
  int first = 0, last = 0;
  Span within(const Span& other) const { return {std::max(first, other.first), std::min(last, other.last)}; }
  bool empty() const { return first >= last; }
};

/// A row of cell centres, cut by half-planes. Along the row the exact side of a line changes once at most, so
/// each cut is found near where rounding says it is, by asking the predicate there.
class Row {
 public:
  Row(const PlanGrid& grid, int y) : grid_(grid), y_(y), height_(grid.centreOf(0, y).y) {}

  /// Centres left of the line or on it; or, with `left` false, strictly right of it.
  Span side(const BorderLine& line, bool left) const {
    const int n = grid_.columns;
    const glm::dvec2 along = line.direction();
    const auto inside = [&](int x) {
      const int turn = orientation(line.from, line.to, grid_.centreOf(x, y_));
      return left ? turn >= 0 : turn < 0;
    };
    if (along.y == 0) return inside(0) ? Span{0, n} : Span{0, 0};
    // A line that rises has its left at the row's beginning.
    const bool begins = (along.y > 0) == left;
    const double crossing = line.from.x + (height_ - line.from.y) * along.x / along.y;
    int cut = cellAfter(crossing);
    while (cut < n && inside(cut) == begins) ++cut;
    while (cut > 0 && inside(cut - 1) != begins) --cut;
    return begins ? Span{0, cut} : Span{cut, n};
  }

  /// Centres at most `reach` from the point.
  Span near(const glm::dvec2& point, double reach) const {
    const int n = grid_.columns;
    if (std::isinf(reach)) return {0, n};
    const double across = height_ - point.y, room = reach * reach - across * across;
    if (!(room >= 0)) return {0, 0};
    const double half = std::sqrt(room);
    Span span{cellAfter(point.x - half), cellAfter(point.x + half)};
    const auto inside = [&](int x) {
      const double dx = grid_.centreOf(x, y_).x - point.x;
      return dx * dx + across * across <= reach * reach;
    };
    while (span.first > 0 && inside(span.first - 1)) --span.first;
    while (span.last < n && inside(span.last)) ++span.last;
    while (!span.empty() && !inside(span.first)) ++span.first;
    while (!span.empty() && !inside(span.last - 1)) --span.last;
    return span;
  }

 private:
  /// The first cell whose centre lies beyond x, about.
  int cellAfter(double x) const {
    const double cell = std::ceil((x - grid_.corner.x) / grid_.step - 0.5);
    return cell > 0 ? static_cast<int>(std::min(cell, double(grid_.columns))) : 0;  // NaN: 0
  }

  const PlanGrid& grid_;
  int y_;
  double height_;
};

std::uint16_t countable(std::size_t count) {
  return static_cast<std::uint16_t>(std::min<std::size_t>(count, kNotCounted - 1));
}

Result<PlanCoverage> emptyCoverage(const PlanGrid& grid) {
  if (Status sound = grid.check(); !sound) return tl::unexpected(sound.error());
  PlanCoverage coverage{grid, {}};
  coverage.counts.resize(std::size_t(grid.columns) * std::size_t(grid.rows), 0);
  return coverage;
}

void leaveOut(const ConvexPolygon& polygon, PlanCoverage& coverage, TaskRunner& runner) {
  const PlanGrid& grid = coverage.grid;
  if (polygon.size() < 3) return;
  runner.parallelFor(std::size_t(grid.rows), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    Span inside{0, grid.columns};
    for (std::size_t k = 0; k < polygon.size() && !inside.empty(); ++k)
      inside = inside.within(
          Row(grid, y).side({polygon.corners[k], polygon.corners[(k + 1) % polygon.size()]}, true));
    for (int x = inside.first; x < inside.last; ++x) coverage.counts[grid.indexOf(x, y)] = kNotCounted;
  });
}

Result<PlanCoverage> coverageAround(const ConvexPolygon& polygon, std::span<const PlanSector> sectors,
                                    const PlanGrid& grid, TaskRunner& runner) {
  auto coverage = coverageOfSectors(sectors, kAnyDistance, grid, runner);
  if (coverage) leaveOut(polygon, *coverage, runner);
  return coverage;
}

}  // namespace

Status PlanGrid::check() const {
  const auto refuse = [](std::string message) {
    return fail(ErrorKind::invalidArgument, std::move(message), "plan coverage");
  };
  if (!(std::isfinite(corner.x + corner.y) && std::isfinite(step) && step > 0 && columns > 0 && rows > 0))
    return refuse("the box is empty or not finite");
  if (double(columns) * rows > kMostPoints)
    return refuse(
        fmt::format("{} x {} points are more than {:.0f}; choose fewer", columns, rows, kMostPoints));
  return {};
}

PlanGrid PlanGrid::over(const glm::dvec2& low, const glm::dvec2& high, int cells) {
  const glm::dvec2 size = high - low;
  PlanGrid grid{low, std::max(size.x, size.y) / cells, 0, 0};
  if (!(grid.step > 0) || !std::isfinite(grid.step)) return grid;
  grid.columns = std::clamp(static_cast<int>(std::ceil(size.x / grid.step - 1e-9)), 1, cells);
  grid.rows = std::clamp(static_cast<int>(std::ceil(size.y / grid.step - 1e-9)), 1, cells);
  return grid;
}

bool PlanSector::holds(const glm::dvec2& point) const {
  return orientation(low.from, low.to, point) >= 0 && orientation(high.from, high.to, point) < 0;
}

PlanSector sectorOf(const LayoutCamera& camera) {
  const auto border = [&](double azimuth) {
    return BorderLine{camera.position, camera.position + directionOf(azimuth)};
  };
  return {camera.position, border(camera.lowAzimuth), border(camera.lowAzimuth + camera.fovRadians)};
}

std::vector<PlanSector> sectorsOf(const Layout& layout) {
  std::vector<std::optional<PlanSector>> found(layout.cameras.size());
  for (const Region& region : layout.regions)
    for (const Cover& cover : region.covers)
      for (const Piece& piece : cover.pieces)
        if (auto& sector = found[std::size_t(piece.camera)]; !sector)
          sector = PlanSector{piece.apex, piece.low, piece.high};
  std::vector<PlanSector> sectors;
  sectors.reserve(found.size());
  for (std::size_t camera = 0; camera < found.size(); ++camera)
    sectors.push_back(found[camera] ? *found[camera] : sectorOf(layout.cameras[camera]));
  return sectors;
}

CoverageShares sharesOf(const PlanCoverage& coverage) {
  CoverageShares shares;
  std::vector<std::size_t> cells;
  std::size_t counted = 0;
  for (const std::uint16_t count : coverage.counts) {
    if (count == kNotCounted) continue;
    if (count >= cells.size()) cells.resize(std::size_t(count) + 1, 0);
    ++cells[count];
    ++counted;
  }
  if (counted == 0) return shares;
  for (std::size_t count = 0; count < cells.size(); ++count) {
    const double share = double(cells[count]) / double(counted);
    shares.byCount.push_back(share);
    (count == 0 ? shares.none : count == 1 ? shares.once : shares.more) += share;
    shares.mean += share * double(count);
  }
  shares.countedArea = double(counted) * coverage.grid.step * coverage.grid.step;
  return shares;
}

Result<PlanCoverage> coverageOfSectors(std::span<const PlanSector> sectors, double reach,
                                       const PlanGrid& grid, TaskRunner& runner, std::stop_token stop) {
  auto coverage = emptyCoverage(grid);
  if (!coverage) return coverage;
  if (!(reach > 0)) return fail(ErrorKind::invalidArgument, "the reach must be positive", "plan coverage");
  runner.parallelFor(std::size_t(grid.rows), [&](std::size_t index) {
    if (stop.stop_requested()) return;
    const int y = static_cast<int>(index);
    const Row row(grid, y);
    std::vector<int> changes(std::size_t(grid.columns) + 1, 0);
    for (const PlanSector& sector : sectors) {
      Span cells = row.near(sector.apex, reach);
      if (!cells.empty()) cells = cells.within(row.side(sector.low, true));
      if (!cells.empty()) cells = cells.within(row.side(sector.high, false));
      if (cells.empty()) continue;
      ++changes[std::size_t(cells.first)];
      --changes[std::size_t(cells.last)];
    }
    int count = 0;
    for (int x = 0; x < grid.columns; ++x) {
      count += changes[std::size_t(x)];
      coverage->counts[grid.indexOf(x, y)] = countable(std::size_t(count));
    }
  });
  if (stop.stop_requested()) return fail(ErrorKind::cancelled, "the count was stopped", "plan coverage");
  return coverage;
}

Result<PlanCoverage> coverageOfApv(const Apv& apv, const PlanGrid& grid, TaskRunner& runner) {
  if (Status sound = apv.check(); !sound) return tl::unexpected(sound.error());
  std::vector<PlanSector> sectors;
  for (const Piece& piece : coverOf(apv).pieces) sectors.push_back({piece.apex, piece.low, piece.high});
  return coverageAround(polygonOf(apv), sectors, grid, runner);
}

Result<PlanCoverage> coverageOfCover(const Region& region, const Cover& cover, const PlanGrid& grid,
                                     TaskRunner& runner) {
  auto coverage = emptyCoverage(grid);
  if (!coverage) return coverage;
  runner.parallelFor(std::size_t(grid.rows), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < grid.columns; ++x)
      coverage->counts[grid.indexOf(x, y)] = countable(std::size_t(std::ranges::count_if(
          cover.pieces, [&](const Piece& piece) { return piece.holds(grid.centreOf(x, y)); })));
  });
  leaveOut(region.polygon, *coverage, runner);
  return coverage;
}

Result<PlanCoverage> coverageOfCorners(const Layout& layout, const Region& region, const PlanGrid& grid,
                                       TaskRunner& runner) {
  const std::vector<PlanSector> all = sectorsOf(layout);
  std::vector<PlanSector> sectors;
  for (std::size_t camera = 0; camera < all.size(); ++camera)
    if (std::ranges::find(region.polygon.corners, layout.cameras[camera].position) !=
        region.polygon.corners.end())
      sectors.push_back(all[camera]);
  return coverageAround(region.polygon, sectors, grid, runner);
}

Result<PlanCoverage> coverageOfLayout(const Layout& layout, double reach, const PlanGrid& grid,
                                      TaskRunner& runner, std::stop_token stop) {
  return coverageOfSectors(sectorsOf(layout), reach, grid, runner, std::move(stop));
}

}  // namespace acentric
