#pragma once
/// Fits the tessellation to a budget: the largest cells whose regions all keep to a number of local
/// triangles. Cell sizes are tried from large to small over an even ladder (each a fixed share smaller than
/// the one before), each with the rotations and origins asked for; then, in steps of one per cent, upwards
/// from the largest that fits. Triangles per region do not simply fall with the cell size (a lattice's
/// borders move over crowded places), so the answer is the largest of the sizes tried, not a root found.

#include <cstddef>
#include <stop_token>
#include <vector>

#include "engine/inspect/budgets.h"

namespace acentric {

struct FitOptions {
  std::size_t mostTriangles = 200'000;  ///< per region
  double leastCell = 0.3;               ///< metres; no smaller cells are tried
  double largestCell = 0;               ///< metres; 0 = the walkable outline's extent
  int sizes = 20;                       ///< sizes on the ladder, 2..200
  int rotations = 1;                    ///< even turns within the lattice's symmetry; 1 = the spec's own
  int origins = 1;                      ///< origins along each of two axes; 1 = the spec's own

  Status check() const;
};

/// One size with the best of its rotations and origins.
struct FitPoint {
  double cellSize = 0;  ///< metres
  double rotationRadians = 0;
  glm::dvec2 latticeOrigin{0};
  std::size_t worst = 0, median = 0;  ///< triangles per region
  std::size_t over = 0;               ///< regions above the budget
  std::size_t regions = 0, cameras = 0;
};

struct FitResult {
  bool satisfied = false;
  /// The layout found: the largest that fits, else the one whose worst region has fewest triangles.
  LayoutSpec spec;
  RegionBudgets budgets;
  std::vector<int> over;        ///< its regions above the budget, most first
  std::vector<FitPoint> curve;  ///< by falling cell size, the refinement's sizes among them
  double leastTried = 0;        ///< metres; above leastCell where smaller cells were too many
  /// Cells added, removed or split one by one that the spec had: with cells of another size their addresses
  /// mean other places, so they are left out.
  std::size_t droppedEdits = 0;
};

/// `spec` gives everything else: configuration, outline, near band, heights.
Result<FitResult> fitToBudget(const LayoutSpec& spec, const TriangleTree& tree, const FitOptions& options,
                              TaskRunner& runner, const Progress& progress = {}, std::stop_token stop = {});

}  // namespace acentric
