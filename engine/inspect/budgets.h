#pragma once
/// Triangles of local geometry per region: how many the scene has when clipped to the region grown by the
/// near band. The scene is prepared once; after an edit of the layout only regions whose polygon is new are
/// counted.

#include <map>
#include <stop_token>
#include <vector>

#include "engine/base/progress.h"
#include "engine/base/task_runner.h"
#include "engine/inspect/triangle_tree.h"
#include "engine/layout/layout.h"
#include "engine/scene/scene.h"

namespace acentric {

struct RegionBudgets {
  std::vector<std::size_t> triangles;  ///< in the order of Layout::regions
  std::size_t counted = 0;             ///< regions that were not known from before

  std::size_t worst() const;   ///< 0 without regions
  std::size_t median() const;  ///< the lower of the two in the middle
  /// Indices of regions with more than `limit` triangles, most first.
  std::vector<int> over(std::size_t limit) const;
};

/// Every region's count, spread over the runner.
Result<RegionBudgets> countRegions(const TriangleTree& tree, const Layout& layout, TaskRunner& runner,
                                   const Progress& progress = {}, std::stop_token stop = {});

/// Counts, and remembers by polygon. Not thread-safe itself; it spreads its work over a TaskRunner.
class BudgetCounter {
 public:
  explicit BudgetCounter(ScenePtr scene);

  /// Cancelled: what was counted until then is remembered.
  Result<RegionBudgets> count(const Layout& layout, TaskRunner& runner, const Progress& progress = {},
                              std::stop_token stop = {});
  const TriangleTree& tree() const { return tree_; }

 private:
  struct Known {
    std::size_t triangles = 0;
    std::uint64_t usedIn = 0;  ///< number of the last count that asked for it
  };
  void forgetOld(std::size_t regions);

  TriangleTree tree_;
  std::map<ContentKey, Known> known_;  ///< by the grown polygon's corners
  std::uint64_t counts_ = 0;
};

/// All at once, for a single look at one layout.
std::vector<std::size_t> countLocalTriangles(const Scene& scene, const Layout& layout);

}  // namespace acentric
