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

Edit pushOut(const Project& project, const ProblemFix& fix) {
  const LayoutSpec& spec = project.layout();
  if (!fix.freeApv) {
    Edit edit = setLatticeOrigin(project, spec.latticeOrigin + fix.push);
    edit.label = trf("Shift the lattice by {:.2f} m", glm::length(fix.push));
    return edit;
  }
  const auto found = spec.freeApvs.find(*fix.freeApv);
  if (found == spec.freeApvs.end()) return {project, tr("Move a panorama")};
  Apv moved = found->second;
  moved.centre += fix.push;
  return setFreeApv(project, *fix.freeApv, moved);
}

Edit changeScale(const Project& project, const Scene& scene, const ProblemFix& fix) {
  const double metres = fix.metresPerUnit.value_or(scene.report.metresPerUnit);
  return {atScale(project, scene, metres), trf("Scale the model to {:g} metres per unit", metres)};
}

}  // namespace acentric::editor
