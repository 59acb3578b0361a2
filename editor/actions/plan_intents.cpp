#include "editor/actions/plan_intents.h"

#include <fmt/format.h>

#include <utility>

#include "editor/actions/path_walk.h"
#include "editor/commands/density_edits.h"
#include "editor/commands/layout_edits.h"
#include "editor/commands/selection.h"
#include "engine/pipeline/camera_path.h"
#include "ui/keys.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

void placeEye(ActionContext& c, const glm::dvec2& position) {
  WalkPose pose = c.state.walker.pose();
  pose.eye = glm::dvec3(clampToPlan(*c.session.built()->layout, position), pose.eye.z);
  c.state.walker.setPose(pose);
}

void turnEye(ActionContext& c, double yawRadians) {
  WalkPose pose = c.state.walker.pose();
  pose.yawRadians = yawRadians;
  c.state.walker.setPose(pose);
}

void takeFreeApv(ActionContext& c, const FreeApvIntent& apv) {
  const Project& project = c.session.project();
  const int number = apv.number.value_or(nextFreeNumber(project.layout()));
  Edit edit = apv.number ? setFreeApv(project, number, apv.apv) : addFreeApv(project, apv.apv);
  if (!apv.finished)
    c.session.applyLive(std::move(edit), false);
  else if (c.session.apply(std::move(edit)))
    c.state.selection = {{number, 0, kFreeSlot}};
}

}  // namespace

bool takeOver(ActionContext& c, View view, int button) {
  if (c.state.planTool.capturing() && c.state.planToolView != view) {
    if (button != ui::mouse::left) return false;
    c.state.planTool.cancel();
    c.session.cancelLive();
  }
  c.state.planToolView = view;
  return true;
}

void moveSelected(ActionContext& c, const std::set<CellId>& cells, const LatticeStep& step) {
  GroupEdit moved = moveCells(c.session.project(), cells, step);
  if (moved.skipped > 0)
    c.session.messages().add(MessageLevel::info, trfMany("{} of the places is taken: nothing was moved",
                                                         "{} of the places are taken: nothing was moved",
                                                         moved.skipped, moved.skipped));
  else if (c.session.apply(std::move(moved.edit)))
    c.state.selection = std::move(moved.cells);
}

void takePlanIntent(ActionContext& c, const PlanIntent& intent) {
  Session& session = c.session;
  EditorState& state = c.state;
  const Project& project = session.project();
  if (const auto* add = std::get_if<AddCellIntent>(&intent)) {
    if (session.apply(addCell(project, add->cell))) state.selection = {add->cell};
  } else if (const auto* remove = std::get_if<RemoveCellIntent>(&intent)) {
    session.apply(removeCells(project, {remove->cell}));
    state.selection.erase(remove->cell);
  } else if (const auto* select = std::get_if<SelectIntent>(&intent)) {
    state.selection = select->cells;
  } else if (const auto* box = std::get_if<MarqueeIntent>(&intent)) {
    state.selection =
        combined(state.selection, cellsTouching(*session.built()->layout, box->low, box->high), box->how);
  } else if (const auto* move = std::get_if<MoveCellsIntent>(&intent)) {
    moveSelected(c, move->cells, move->step);
  } else if (const auto* lattice = std::get_if<LatticeIntent>(&intent)) {
    session.apply(setLattice(project, lattice->place, LatticeTool::labelOf(*lattice)));
  } else if (const auto* place = std::get_if<PlaceEyeIntent>(&intent)) {
    placeEye(c, place->position);
  } else if (const auto* turn = std::get_if<TurnEyeIntent>(&intent)) {
    turnEye(c, turn->yawRadians);
  } else if (const auto* outline = std::get_if<OutlineIntent>(&intent)) {
    session.applyLive(setOutline(project, outline->outline), outline->finished);
  } else if (const auto* paint = std::get_if<PaintDensityIntent>(&intent)) {
    if (!paint->cells.empty())
      session.apply(setDensity(project, paint->cells, paint->erase ? 1 : state.densityBrush));
  } else if (const auto* path = std::get_if<PathIntent>(&intent)) {
    takePathIntent(c, *path);
  } else if (const auto* apv = std::get_if<FreeApvIntent>(&intent)) {
    takeFreeApv(c, *apv);
  }
}

}  // namespace acentric::editor
