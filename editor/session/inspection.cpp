#include "editor/session/inspection.h"

#include "engine/pipeline/scene_probe.h"

namespace acentric::editor {

Result<Inspection> Inspector::inspect(const OpenProject& open, TaskRunner& runner, const Progress& progress,
                                      std::stop_token stop) {
  if (scene_ != open.scene) {
    counter_ = std::make_unique<BudgetCounter>(open.scene);
    scale_ = doubtScale(*open.rays, {});
    scene_ = open.scene;
  }
  auto budgets = counter_->count(*open.layout, runner, progress, stop);
  if (!budgets) return tl::unexpected(budgets.error());
  auto placement = checkPlacement(*open.layout, open.scene->bounds, {}, probeFor(*open.rays), runner, stop);
  if (!placement) return tl::unexpected(placement.error());
  return Inspection{open.layout, std::move(*budgets), std::move(*placement), scale_};
}

}  // namespace acentric::editor
