#include "engine/inspect/walkable_outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/inspect/floor_choice.h"

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
  auto choice = chooseFloor(bounds, *grid, options, probe);
  if (!choice) return tl::unexpected(choice.error());
  return std::move(choice->area);
}

}  // namespace acentric
