#include "engine/layout/placement.h"

#include <algorithm>
#include <cmath>

#include "engine/layout/region_limit.h"

namespace acentric {
namespace {

/// Cells [iLow, iHigh] x [jLow, jHigh].
struct CellRange {
  std::int64_t iLow, jLow, iHigh, jHigh;
  bool single() const { return iLow == iHigh && jLow == jHigh; }
};

/// Halves the range until single cells are left; whole ranges clear of the outline are dropped at once, so
/// the work follows the number of regions found, not the size of the plane between them.
void search(const Outline& outline, const Lattice& lattice, const CellRange& range, std::size_t limit,
            std::vector<CellId>& found) {
  if (found.size() > limit) return;
  if (!outline.overlaps(lattice.hullOf(range.iLow, range.jLow, range.iHigh, range.jHigh))) return;
  if (range.single()) {
    for (int slot = 0; slot < lattice.slots(); ++slot) {
      const CellId id{static_cast<int>(range.iLow), static_cast<int>(range.jLow), slot};
      if (outline.overlaps(lattice.polygonOf(id))) found.push_back(id);
    }
    return;
  }
  CellRange first = range, second = range;
  if (range.iHigh - range.iLow >= range.jHigh - range.jLow) {
    first.iHigh = range.iLow + (range.iHigh - range.iLow) / 2;
    second.iLow = first.iHigh + 1;
  } else {
    first.jHigh = range.jLow + (range.jHigh - range.jLow) / 2;
    second.jLow = first.jHigh + 1;
  }
  search(outline, lattice, first, limit, found);
  search(outline, lattice, second, limit, found);
}

}  // namespace

std::vector<CellId> cellsOverlapping(const Outline& outline, const Lattice& lattice, std::size_t limit) {
  glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
  for (const auto& loop : outline.loops)
    for (const glm::dvec2& point : loop) {
      const glm::dvec2 at = lattice.cellCoordinates(point);
      low = glm::min(low, at), high = glm::max(high, at);
    }
  std::vector<CellId> found;
  if (!(low.x <= high.x)) return found;
  const auto index = [](double value) {
    return static_cast<std::int64_t>(std::clamp(value, -double(kMaxCellIndex), double(kMaxCellIndex)));
  };
  search(outline, lattice,
         {index(std::floor(low.x) - 1), index(std::floor(low.y) - 1), index(std::ceil(high.x) + 1),
          index(std::ceil(high.y) + 1)},
         limit, found);
  std::ranges::sort(found);
  return found;
}

namespace {

/// The regions that a placed one gives way to, by its splits: all parts of one that was added by hand, else
/// those that overlap the outline.
void addLeaves(const CellId& cell, bool byHand, const LayoutSpec& spec, const Lattice& lattice,
               std::vector<CellId>& leaves) {
  if (spec.removed.contains(cell)) return;
  if (!spec.split.contains(cell)) {
    leaves.push_back(cell);
    return;
  }
  for (const CellId& child : lattice.childrenOf(cell)) {
    const bool childByHand = byHand || spec.added.contains(child);
    if (childByHand || spec.outline.overlaps(lattice.polygonOf(child)))
      addLeaves(child, childByHand, spec, lattice, leaves);
  }
}

}  // namespace

namespace {

enum class Reached : std::uint8_t { no, byOutline, byHand };

/// Does a cell share in what is placed, by the splits above it?
Reached reached(const LayoutSpec& spec, const Lattice& lattice, const CellId& cell) {
  if (spec.removed.contains(cell)) return Reached::no;
  if (spec.added.contains(cell)) return Reached::byHand;
  if (cell.level > 0) {
    const CellId whole = lattice.parentOf(cell);
    if (!spec.split.contains(whole)) return Reached::no;
    if (const Reached above = reached(spec, lattice, whole); above != Reached::byOutline) return above;
  }
  return spec.outline.overlaps(lattice.polygonOf(cell)) ? Reached::byOutline : Reached::no;
}

}  // namespace

bool isPlaced(const LayoutSpec& spec, const Lattice& lattice, const CellId& cell) {
  return !spec.split.contains(cell) && reached(spec, lattice, cell) != Reached::no;
}

Result<std::vector<CellId>> placedCells(const LayoutSpec& spec, const Lattice& lattice) {
  const std::size_t limit = std::size_t(kMaxRegions) + spec.removed.size();
  std::vector<CellId> cells = cellsOverlapping(spec.outline, lattice, limit);
  if (cells.size() > limit) {
    double perimeter = 0;
    for (const auto& loop : spec.outline.loops)
      for (std::size_t k = 0; k < loop.size(); ++k)
        perimeter += glm::distance(loop[k], loop[(k + 1) % loop.size()]);
    const double estimate = spec.outline.area() / lattice.meanRegionArea() + perimeter / spec.cellSize;
    return tooManyRegions(std::max(estimate, double(cells.size())), spec.cellSize);
  }
  std::vector<CellId> whole, placed;
  // Parts that were added by hand within a whole that is not placed stand for themselves.
  std::ranges::set_union(cells, spec.added, std::back_inserter(whole));
  for (const CellId& cell : whole) addLeaves(cell, spec.added.contains(cell), spec, lattice, placed);
  std::ranges::sort(placed);
  const auto repeats = std::ranges::unique(placed);
  placed.erase(repeats.begin(), repeats.end());
  if (placed.size() > std::size_t(kMaxRegions)) return tooManyRegions(double(placed.size()), spec.cellSize);
  return placed;
}

}  // namespace acentric
