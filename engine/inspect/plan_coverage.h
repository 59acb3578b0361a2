#pragma once
/// How many cameras hold each point of the plan: over- and under-sampling as in the paper's Figs. 1-3. A
/// raster of counts at cell centres; each count is exact (half-open sectors, exact predicate), so what lies
/// between two neighbouring sectors is never a rounding error. Pure geometry: walls are not asked
/// (surface_coverage.h does).
///
/// Outside its polygon an ideal acentric panorama view shows 1 everywhere, and so does each cover of a
/// region. The cameras at a gap's own corners show more where a configuration over-samples (apv.md section
/// 3).

#include <cstdint>
#include <limits>
#include <span>
#include <stop_token>
#include <vector>

#include "engine/base/task_runner.h"
#include "engine/layout/apv.h"
#include "engine/layout/layout.h"

namespace acentric {

/// Square cells in plan; cell (x, y) covers corner + step * [x, x+1) x [y, y+1). Row 0 is the lowest.
struct PlanGrid {
  glm::dvec2 corner{0};
  double step = 0;  ///< metres
  int columns = 0, rows = 0;

  Status check() const;  ///< finite, step > 0, 1..2^26 cells
  glm::dvec2 centreOf(int x, int y) const {
    return {corner.x + step * (x + 0.5), corner.y + step * (y + 0.5)};
  }
  std::size_t indexOf(int x, int y) const { return std::size_t(y) * std::size_t(columns) + std::size_t(x); }
  /// About `cells` cells along the longer side of the box, so that the box is covered.
  static PlanGrid over(const glm::dvec2& low, const glm::dvec2& high, int cells);
};

/// A camera's horizontal field of view, less than half a turn wide.
struct PlanSector {
  glm::dvec2 apex{0};
  BorderLine low, high;  ///< points on `low` belong to it, points on `high` do not
  bool holds(const glm::dvec2& point) const;
};
PlanSector sectorOf(const LayoutCamera& camera);
/// Of every camera, in order of Layout::cameras. Neighbouring sectors share the very lines of the covers.
std::vector<PlanSector> sectorsOf(const Layout& layout);

inline constexpr std::uint16_t kNotCounted = 0xffff;  ///< inside the polygon that the cameras surround
inline constexpr double kAnyDistance = std::numeric_limits<double>::infinity();

struct PlanCoverage {
  PlanGrid grid;
  std::vector<std::uint16_t> counts;  ///< by PlanGrid::indexOf; at most kNotCounted - 1
};

/// Shares of the counted area.
struct CoverageShares {
  std::vector<double> byCount;  ///< [k]: held by exactly k cameras
  double none = 0, once = 0, more = 0;
  double mean = 0;         ///< cameras per point
  double countedArea = 0;  ///< square metres
};
CoverageShares sharesOf(const PlanCoverage& coverage);

/// Any sectors; a point farther than `reach` metres from an apex is not held by it.
Result<PlanCoverage> coverageOfSectors(std::span<const PlanSector> sectors, double reach,
                                       const PlanGrid& grid, TaskRunner& runner, std::stop_token stop = {});
/// One APV alone; its polygon is not counted.
Result<PlanCoverage> coverageOfApv(const Apv& apv, const PlanGrid& grid, TaskRunner& runner);
/// One cover; the region is not counted.
Result<PlanCoverage> coverageOfCover(const Region& region, const Cover& cover, const PlanGrid& grid,
                                     TaskRunner& runner);
/// All cameras of the layout that stand at the region's own corners; the region is not counted.
Result<PlanCoverage> coverageOfCorners(const Layout& layout, const Region& region, const PlanGrid& grid,
                                       TaskRunner& runner);
/// All cameras of the layout.
Result<PlanCoverage> coverageOfLayout(const Layout& layout, double reach, const PlanGrid& grid,
                                      TaskRunner& runner, std::stop_token stop = {});

}  // namespace acentric
