#include "editor/session/coverage.h"

#include <algorithm>

#include "engine/pipeline/coverage.h"

namespace acentric::editor {
namespace {

constexpr int kMostEyes = 10'000;  ///< that look at each point

Result<PlanCoverage> countOn(const PlanGrid& grid, const Layout& layout, const CoverageRequest& request,
                             std::optional<int> region, TaskRunner& runner, const std::stop_token& stop) {
  if (request.kind == CoverageKind::layout) return coverageOfLayout(layout, kAnyDistance, grid, runner, stop);
  const Region& cell = layout.regions[std::size_t(*region)];
  if (cell.id.slot == kFreeSlot) return coverageOfApv(layout.spec.freeApvs.at(cell.id.i), grid, runner);
  return coverageOfCorners(layout, cell, grid, runner);
}

/// The least share that a cover of the region holds exactly once: all of it, or the layout is wrong.
double leastHeldOnce(const Region& region, const PlanGrid& grid, TaskRunner& runner) {
  double least = 1;
  for (const Cover& cover : region.covers)
    if (const auto counted = coverageOfCover(region, cover, grid, runner))
      least = std::min(least, sharesOf(*counted).once);
  return least;
}

Status measurePlan(const OpenProject& open, const CoverageRequest& request, TaskRunner& runner,
                   const std::function<void(const CoveragePicturePtr&)>& show, const std::stop_token& stop) {
  const Layout& layout = *open.layout;
  std::optional<int> region;
  if (request.kind == CoverageKind::cell) {
    if (request.cell) region = layout.findRegion(*request.cell);
    if (!region) return {};
  }
  if (layout.regions.empty()) return {};
  // Each row asks every camera: a first picture of few rows where cameras are many.
  const int first =
      request.kind == CoverageKind::cell
          ? 128
          : std::clamp(int(1'000'000 / std::max<std::size_t>(layout.cameras.size(), 1)), 12, 96);
  std::optional<double> once;
  for (int cells = first;; cells = std::min(4 * cells, kPlanCoverageCells)) {
    auto counted = countOn(coverageGrid(layout, request, cells), layout, request, region, runner, stop);
    if (!counted) return tl::unexpected(counted.error());
    auto picture = std::make_shared<CoveragePicture>();
    picture->request = request;
    picture->layout = open.layout;
    picture->shares = sharesOf(*counted);
    const std::vector<double>& byCount = picture->shares.byCount;
    picture->mostCameras = std::max(0, int(byCount.size()) - 1);
    picture->fewestCameras = 1;
    while (picture->fewestCameras < picture->mostCameras && byCount[std::size_t(picture->fewestCameras)] == 0)
      ++picture->fewestCameras;
    if (region) {
      const Region& cell = layout.regions[std::size_t(*region)];
      if (!once) once = leastHeldOnce(cell, coverageGrid(layout, request, cells), runner);
      picture->covers = int(cell.covers.size());
      picture->coverHoldsOnce = *once;
    }
    picture->plan = std::move(*counted);
    picture->exact = cells == kPlanCoverageCells;
    picture->progress = double(cells) / kPlanCoverageCells;
    show(picture);
    if (cells == kPlanCoverageCells) return {};
  }
}

double medianRateOf(const SurfaceCoverage& coverage) {
  std::vector<double> rates;
  for (const PointCoverage& point : coverage.points)
    if (point.surfaceClass >= SurfaceClass::under)
      rates.push_back(point.samplesPerMetre / point.pixelsPerMetre);
  if (rates.empty()) return 0;
  const auto middle = rates.begin() + std::ptrdiff_t(rates.size() / 2);
  std::ranges::nth_element(rates, middle);
  return *middle;
}

Status measureSurfaces(const OpenProject& open, const CoverageRequest& request, TaskRunner& runner,
                       const std::function<void(const CoveragePicturePtr&)>& show,
                       const std::stop_token& stop) {
  const ProjectReach reach(open);
  const SurfaceCoverageOptions options = coverageOptions(open);
  std::size_t eyes = 0;
  for (const auto& ofRegion : standingEyes(*open.layout, options.eyes)) eyes += ofRegion.size();
  const auto tell = [&](const SurfaceCoveragePtr& snapshot) {
    auto picture = std::make_shared<CoveragePicture>();
    picture->request = request;
    picture->layout = open.layout;
    picture->surfaces = snapshot;
    picture->medianRate = medianRateOf(*snapshot);
    picture->eyes = eyes;
    picture->progress = double(snapshot->points.size()) / snapshot->wanted;
    picture->exact = snapshot->complete;
    show(picture);
  };
  const auto measured = measureSurfaceCoverage(open.scene, *reach, options, runner, tell, stop);
  if (!measured) return tl::unexpected(measured.error());
  return {};
}

}  // namespace

PlanGrid coverageGrid(const Layout& layout, const CoverageRequest& request, int cells) {
  glm::dvec2 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  const auto add = [&](const ConvexPolygon& polygon) {
    for (const glm::dvec2& corner : polygon.corners)
      low = glm::min(low, corner), high = glm::max(high, corner);
  };
  const auto region =
      request.kind == CoverageKind::cell && request.cell ? layout.findRegion(*request.cell) : std::nullopt;
  if (!region) {
    for (const Region& each : layout.regions) add(each.grown);
    return PlanGrid::over(low, high, cells);
  }
  const ConvexPolygon& polygon = layout.regions[std::size_t(*region)].polygon;
  add(polygon);
  constexpr double kAround = 4;  // times the cell's own extent
  const glm::dvec2 half = kAround * (high - low), centre = 0.5 * (low + high);
  return PlanGrid::over(centre - half, centre + half, cells);
}

SurfaceCoverageOptions coverageOptions(const OpenProject& open) {
  SurfaceCoverageOptions options = surfaceCoverageOptionsFor(open.project, kJudgedDisplayWidth);
  const int regions = std::max(int(open.layout->regions.size()), 1);
  options.eyes.perRegion = std::clamp(kMostEyes / regions, 1, options.eyes.perRegion);
  if (regions > kMostEyes) options.eyes.mostRegions = kMostEyes;
  return options;
}

Status measureCoverage(const OpenProject& open, const CoverageRequest& request, TaskRunner& runner,
                       const std::function<void(const CoveragePicturePtr&)>& show, std::stop_token stop) {
  if (request.kind == CoverageKind::surfaces) return measureSurfaces(open, request, runner, show, stop);
  return measurePlan(open, request, runner, show, stop);
}

}  // namespace acentric::editor
