#include "editor/actions/problem_actions.h"

#include <fmt/format.h>

#include "editor/commands/layout_edits.h"
#include "engine/pipeline/scene_scale.h"
#include "ui/translate.h"

namespace acentric::editor {

void showProblem(EditorState& state, const ProblemPlace& place) {
  if (!place.cells.empty()) state.selection = place.cells;
  if (place.framed()) {
    const glm::dvec2 margin = 0.75 * (place.high - place.low);  // so that its neighbours are seen too
    state.framePlan = PlanFrame{place.low - margin, place.high + margin};
  }
  switch (place.look) {
    case PlanLook::unchanged:
      break;
    case PlanLook::checks:
      state.overlay = PlanOverlay::checks;
      break;
    case PlanLook::triangles:
      state.overlay = PlanOverlay::triangles;
      break;
    case PlanLook::coverage:
      state.overlay = PlanOverlay::coverage;
      state.coverageKind = CoverageKind::surfaces;
      break;
  }
  if (!place.section.empty()) state.openSection = place.section;
  if (place.bakeCameras) state.showBakeCameras = true;
}

std::optional<Edit> editOf(const ProblemFix& fix, const Project& project, const Scene& scene) {
  struct {
    const Project& project;
    const Scene& scene;
    std::optional<Edit> operator()(const RunAction&) const { return std::nullopt; }
    std::optional<Edit> operator()(const MoveFreeApv& move) const {
      const auto found = project.layout().freeApvs.find(move.number);
      if (found == project.layout().freeApvs.end()) return std::nullopt;
      Apv moved = found->second;
      moved.centre += move.by;
      return setFreeApv(project, move.number, moved);
    }
    std::optional<Edit> operator()(const AddPanorama& add) const {
      return addFreeApv(project, Apv{add.place, {0, 0}});
    }
    std::optional<Edit> operator()(const RemoveCell& remove) const {
      return removeCells(project, {remove.cell});
    }
    std::optional<Edit> operator()(const ScaleModel& scale) const {
      return Edit{atScale(project, scene, scale.metresPerUnit),
                  trf("Scale the model to {:g} metres per unit", scale.metresPerUnit)};
    }
  } const edit{project, scene};
  return std::visit(edit, fix.way);
}

}  // namespace acentric::editor
