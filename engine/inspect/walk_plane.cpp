#include "engine/inspect/walk_plane.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/conventions.h"
#include "engine/inspect/cell_mask.h"
#include "engine/inspect/simplify_outline.h"

namespace acentric {
namespace {

constexpr std::size_t kMostCorners = 2000;

/// The floor about one height as a mask: a cell has one spot there at most.
struct Slice {
  CellMask mask;
  CellLinks links;
  std::vector<int> spotOf;  ///< per cell; -1 = none
};

Slice sliceAt(const Standing& standing, double height, double tolerance,
              std::span<const std::uint8_t> taken) {
  const ProbeGrid& grid = standing.grid;
  Slice slice{CellMask(grid.columns, grid.rows), {}, {}};
  slice.spotOf.assign(slice.mask.cells.size(), -1);
  const auto away = [&](int spot) {
    return std::abs(double(standing.spots[std::size_t(spot)].height) - height);
  };
  for (std::size_t s = 0; s < standing.spots.size(); ++s) {
    if (!taken.empty() && taken[s] != 0) continue;
    const int spot = static_cast<int>(s);
    const std::size_t cell = grid.index(standing.spots[s].x, standing.spots[s].y);
    int& kept = slice.spotOf[cell];
    if (away(spot) <= tolerance && (kept < 0 || away(spot) < away(kept))) kept = spot;
    slice.mask.cells[cell] = kept >= 0 ? 1 : 0;
  }
  slice.links.right.assign(slice.mask.cells.size(), 0);
  slice.links.up.assign(slice.mask.cells.size(), 0);
  for (std::size_t cell = 0; cell < slice.spotOf.size(); ++cell) {
    if (slice.spotOf[cell] < 0) continue;
    const StandingSpot& spot = standing.spots[std::size_t(slice.spotOf[cell])];
    const auto joined = [&](std::size_t side, std::size_t neighbour) {
      return spot.next[side] >= 0 && spot.next[side] == slice.spotOf[neighbour] ? 1 : 0;
    };
    if (spot.x + 1 < grid.columns) slice.links.right[cell] = std::uint8_t(joined(0, cell + 1));
    if (spot.y + 1 < grid.rows)
      slice.links.up[cell] = std::uint8_t(joined(1, cell + std::size_t(grid.columns)));
  }
  return slice;
}

Outline traceOutline(const CellMask& mask, const ProbeGrid& grid) {
  Outline outline;
  for (const auto& loop : traceLoops(mask)) {
    std::vector<glm::dvec2> corners;
    double twiceArea = 0;
    for (const glm::ivec2& corner : loop) corners.push_back(grid.corner + grid.step * glm::dvec2(corner));
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
      twiceArea += cross(corners[k] - corners[0], corners[k + 1] - corners[0]);
    // One connected part has one outer loop: it comes first.
    outline.loops.insert(twiceArea > 0 ? outline.loops.begin() : outline.loops.end(), std::move(corners));
  }
  return outline;
}

std::size_t cornersOf(const Outline& outline) {
  std::size_t corners = 0;
  for (const auto& loop : outline.loops) corners += loop.size();
  return corners;
}

WalkPlane planeOf(const CellMask& part, const Slice& slice, const Standing& standing) {
  WalkPlane plane;
  std::vector<float> heights;
  std::size_t covered = 0;
  for (std::size_t cell = 0; cell < part.cells.size(); ++cell) {
    if (part.cells[cell] == 0) continue;
    plane.spots.push_back(slice.spotOf[cell]);
    const StandingSpot& spot = standing.spots[std::size_t(slice.spotOf[cell])];
    heights.push_back(spot.height);
    covered += spot.covered ? 1 : 0;
    plane.enclosure += double(spot.enclosure);
  }
  const auto middle = heights.begin() + std::ptrdiff_t(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  plane.height = *middle;
  plane.coveredShare = double(covered) / double(heights.size());
  plane.enclosure /= double(heights.size());
  plane.outline = outlineAround(part, standing.grid);
  return plane;
}

}  // namespace

Outline outlineAround(const CellMask& part, const ProbeGrid& grid) {
  const Outline traced = traceOutline(part, grid);
  Outline outline = simplifyOutline(traced, grid.step);
  for (double coarser = 2; cornersOf(outline) > kMostCorners && coarser <= 16; coarser *= 2)
    outline = simplifyOutline(traced, coarser * grid.step);
  return outline;
}

CellMask largestClearPart(const CellMask& mask, const CellLinks& links) {
  // Taking corner contacts off can part what is left, so both are repeated until nothing changes.
  CellMask part = largestPart(mask, links);
  for (std::size_t before = part.count() + 1; part.count() < before;) {
    before = part.count();
    removeCornerContacts(part);
    part = largestPart(part, links);
  }
  return part;
}

std::vector<WalkPlane> planesAt(const Standing& standing, double height, double tolerance, int most,
                                int leastSpots, std::span<const std::uint8_t> taken) {
  Slice slice = sliceAt(standing, height, tolerance, taken);
  std::vector<WalkPlane> planes;
  while (static_cast<int>(planes.size()) < most) {
    const CellMask part = largestClearPart(slice.mask, slice.links);
    if (part.count() < std::size_t(std::max(1, leastSpots))) break;
    planes.push_back(planeOf(part, slice, standing));
    for (std::size_t cell = 0; cell < part.cells.size(); ++cell)
      if (part.cells[cell] != 0) slice.mask.cells[cell] = 0;
  }
  return planes;
}

}  // namespace acentric
