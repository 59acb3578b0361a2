#pragma once
/// What the plan shows of a layout before it is baked: triangles of local geometry per region, and where
/// centres of projection stand badly. Made in the background after each edit.

#include <memory>
#include <optional>
#include <stop_token>

#include "engine/inspect/budgets.h"
#include "engine/inspect/placement_checks.h"
#include "engine/pipeline/pipeline.h"
#include "engine/pipeline/scene_scale.h"

namespace acentric::editor {

struct Inspection {
  std::shared_ptr<const Layout> layout;  ///< that it is of
  RegionBudgets budgets;
  PlacementReport placement;
  std::optional<ScaleDoubt> scale;
};

/// Remembers the scene's tree and the counts of regions that an edit leaves alone. One caller at a time.
class Inspector {
 public:
  Result<Inspection> inspect(const OpenProject& open, TaskRunner& runner, const Progress& progress,
                             std::stop_token stop);

 private:
  ScenePtr scene_;
  std::optional<ScaleDoubt> scale_;  ///< of scene_
  std::unique_ptr<BudgetCounter> counter_;
};

}  // namespace acentric::editor
