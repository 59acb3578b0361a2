#pragma once
/// Sampling coverage for the plan: how many cameras hold each point, or how well the captures would serve the
/// surfaces that a walker can see. Measured in the background, coarse at first and better with each picture,
/// until it is exact: then it is what the engine's functions give for the whole.

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>

#include "engine/inspect/plan_coverage.h"
#include "engine/inspect/surface_coverage.h"
#include "engine/pipeline/pipeline.h"

namespace acentric::editor {

enum class CoverageKind {
  layout,   ///< cameras of the layout per point of the plan
  cell,     ///< the same of the cameras at one region's corners, or of one free APV
  surfaces  ///< rates on the surfaces
};

struct CoverageRequest {
  CoverageKind kind = CoverageKind::layout;
  std::optional<CellId> cell;  ///< with `cell`: which; nothing, or a cell that is not placed: no picture
  bool operator==(const CoverageRequest&) const = default;
};

struct CoveragePicture {
  CoverageRequest request;
  std::shared_ptr<const Layout> layout;    ///< that it is of
  PlanCoverage plan;                       ///< layout, cell
  CoverageShares shares;                   ///< of `plan`
  int fewestCameras = 0, mostCameras = 0;  ///< at any point of `plan` that some hold
  int covers = 0;                          ///< of the cell
  double coverHoldsOnce = 0;               ///< cell: share of `plan` that each of them holds exactly once
  SurfaceCoveragePtr surfaces;             ///< surfaces
  double medianRate = 0;                   ///< samples per pixel, of the points that are sampled at all
  std::size_t eyes = 0;                    ///< surfaces: that look from the walkable area

  double progress = 0;  ///< 0..1
  bool exact = false;
};
using CoveragePicturePtr = std::shared_ptr<const CoveragePicture>;

/// Display that surfaces are judged for, pixels wide.
inline constexpr int kJudgedDisplayWidth = 960;
/// Cells along the longer side of the plan's grid at rest; fewer before.
inline constexpr int kPlanCoverageCells = 512;

/// The grid at rest: around all regions, or around the one.
PlanGrid coverageGrid(const Layout& layout, const CoverageRequest& request, int cells = kPlanCoverageCells);
/// As surfaces of the project are judged. Layouts of very many regions have fewer eyes in each, then in some.
SurfaceCoverageOptions coverageOptions(const OpenProject& open);

/// Calls `show` with ever better pictures, on the calling thread, the last one exact. A stop ends it with
/// `cancelled`.
Status measureCoverage(const OpenProject& open, const CoverageRequest& request, TaskRunner& runner,
                       const std::function<void(const CoveragePicturePtr&)>& show, std::stop_token stop = {});

}  // namespace acentric::editor
