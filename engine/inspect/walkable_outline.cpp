#include "engine/inspect/walkable_outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/geometry/conventions.h"
#include "engine/inspect/cell_mask.h"
#include "engine/inspect/floor_levels.h"
#include "engine/inspect/simplify_outline.h"

namespace acentric {
namespace {

constexpr double kHeadAboveEye = 0.15;  // metres
constexpr int kStandardCells = 200;     // along the longer side
constexpr double kMostCells = 4e6;
constexpr std::size_t kMostCorners = 2000;

tl::unexpected<Error> refuse(std::string message) {
  return fail(ErrorKind::invalidArgument, std::move(message), "walkable area");
}

Status checkRange(const char* what, double value, double low, double high) {
  if (value >= low && value <= high) return {};
  return refuse(fmt::format("{} is {} m; it must lie in {}..{} m", what, value, low, high));
}

Status check(const WalkableOptions& options) {
  for (const Status& status : {checkRange("the eye height", options.eyeHeight, 0.001, 1000),
                               checkRange("the floor tolerance", options.floorTolerance, 0, 100),
                               checkRange("the wall clearance", options.wallClearance, 0, 100),
                               checkRange("the grid step", options.gridStep, 0, 1e6)})
    if (!status) return status;
  if (std::isinf(options.floorHeight)) return refuse("the floor height must be finite, or left out");
  return {};
}

Result<ProbeGrid> layGrid(const Bounds& bounds, const WalkableOptions& options) {
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

/// Cells where one can stand at the chosen floor, and between which one can step.
struct Standing {
  CellMask mask;
  CellLinks links;
};

/// Heights above the floor at which obstacles count: between knee and head.
std::array<double, 3> probeHeights(double eyeHeight) {
  const double knee = std::min(0.5, 0.3 * eyeHeight);
  return {knee, 0.5 * (knee + eyeHeight), eyeHeight};
}

Standing findStanding(const ProbeGrid& grid, const FloorLevels& levels, double floorHeight,
                      const WalkableOptions& options, const DistanceProbe& probe) {
  Standing standing{CellMask(grid.columns, grid.rows), {}};
  std::vector<float> heightOf(standing.mask.cells.size(), 0);
  for (std::size_t cell = 0; cell < levels.size(); ++cell) {
    const auto away = [&](float z) { return std::abs(double(z) - floorHeight); };
    const auto nearest = std::ranges::min_element(levels[cell], {}, away);
    if (nearest == levels[cell].end() || away(*nearest) > options.floorTolerance) continue;
    standing.mask.cells[cell] = 1;
    heightOf[cell] = *nearest;
  }

  // Free way from each cell in eight directions, the least over the heights.
  const CellMask floor = standing.mask;
  std::vector<std::array<float, 4>> freeWay(floor.cells.size());  // +x, +y, -x, -y
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x) {
      const std::size_t cell = floor.index(x, y);
      if (floor.cells[cell] == 0) continue;
      for (int d = 0; d < 8; ++d) {
        const glm::dvec2 direction = directionOf(kTwoPi * d / 8);
        double least = std::numeric_limits<double>::infinity();
        for (const double above : probeHeights(options.eyeHeight)) {
          const double distance =
              probe({grid.centreOf(x, y), double(heightOf[cell]) + above}, {direction, 0});
          if (distance < least) least = distance;
        }
        if (least < options.wallClearance) standing.mask.cells[cell] = 0;
        if (d % 2 == 0) freeWay[cell][std::size_t(d / 2)] = static_cast<float>(least);
      }
    }

  standing.links.right.assign(floor.cells.size(), 0);
  standing.links.up.assign(floor.cells.size(), 0);
  const auto step = static_cast<float>(grid.step);
  const auto linked = [&](std::size_t from, std::size_t to, std::size_t forth, std::size_t back) {
    return freeWay[from][forth] >= step && freeWay[to][back] >= step &&
           std::abs(heightOf[from] - heightOf[to]) <= options.floorTolerance;
  };
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x) {
      const std::size_t cell = floor.index(x, y);
      if (standing.mask.at(x, y) && standing.mask.at(x + 1, y))
        standing.links.right[cell] = linked(cell, floor.index(x + 1, y), 0, 2) ? 1 : 0;
      if (standing.mask.at(x, y) && standing.mask.at(x, y + 1))
        standing.links.up[cell] = linked(cell, floor.index(x, y + 1), 1, 3) ? 1 : 0;
    }
  return standing;
}

Outline outlineOf(const CellMask& mask, const ProbeGrid& grid) {
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

}  // namespace

Result<WalkableArea> findWalkableArea(const Bounds& bounds, const WalkableOptions& options,
                                      const DistanceProbe& probe) {
  if (Status status = check(options); !status) return tl::unexpected(status.error());
  const Result<ProbeGrid> grid = layGrid(bounds, options);
  if (!grid) return tl::unexpected(grid.error());

  const double headRoom = options.eyeHeight + kHeadAboveEye;
  const FloorLevels levels = findFloorLevels(bounds, *grid, headRoom, probe);
  const auto none = [&](const std::string& what) {
    return fail(
        ErrorKind::notFound,
        fmt::format("{}; lower the eye height, or give the floor height or the outline yourself", what),
        "walkable area");
  };
  std::optional<double> floorHeight = options.floorHeight;
  if (std::isnan(options.floorHeight)) floorHeight = dominantLevel(levels, options.floorTolerance);
  if (!floorHeight) return none(fmt::format("no surface has {:.2f} m of room above it", headRoom));

  const Standing standing = findStanding(*grid, levels, *floorHeight, options, probe);
  CellMask area = largestPart(standing.mask, standing.links);
  // Taking off corner contacts can part what is left, so both are repeated until nothing changes.
  for (std::size_t before = area.count() + 1; area.count() < before;) {
    before = area.count();
    removeCornerContacts(area);
    area = largestPart(area, standing.links);
  }
  if (area.count() == 0)
    return none(
        fmt::format("no place at height {:.2f} m has {:.2f} m of room above it and {:.2f} m to the sides",
                    *floorHeight, headRoom, options.wallClearance));

  const Outline traced = outlineOf(area, *grid);
  Outline outline = simplifyOutline(traced, grid->step);
  for (double coarser = 2; cornersOf(outline) > kMostCorners && coarser <= 16; coarser *= 2)
    outline = simplifyOutline(traced, coarser * grid->step);
  return WalkableArea{*floorHeight, std::move(outline)};
}

}  // namespace acentric
