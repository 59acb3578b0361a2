/// What the user does in the plan: events go to its tools, their intentions become edits.

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "editor/actions/path_walk.h"
#include "editor/commands/layout_edits.h"
#include "editor/commands/selection.h"
#include "editor/panels/plan_panel.h"
#include "engine/pipeline/camera_path.h"
#include "ui/canvas_draw.h"
#include "ui/keys.h"
#include "ui/translate.h"

namespace acentric::editor {

std::optional<CellId> PlanPanel::hoveredCell(const PanelContext& context) const {
  const EditorState& state = context.actions.state;
  const LayoutSpec& spec = context.actions.session.project().layout();
  const bool pointing = state.planTool.mode() == PlanMode::cells && !context.inputBlocked &&
                        contains(pointer_) && !state.planTool.capturing() &&
                        spec.cellSize * view_.pixelsPerMetre() >= kLeastCellPixels;
  if (!pointing) return std::nullopt;
  return cellAt(spec, view_.worldFromScreen(pointer_)).id;
}

void PlanPanel::act(PanelContext& context, const PlanIntent& intent) {
  Session& session = context.session();
  EditorState& state = context.state();
  const Project& project = session.project();
  const auto placeEye = [&](const glm::dvec2& position) {
    WalkPose pose = state.walker.pose();
    pose.eye = glm::dvec3(clampToPlan(*session.built()->layout, position), pose.eye.z);
    state.walker.setPose(pose);
  };
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
    GroupEdit moved = moveCells(project, move->cells, move->step);
    if (moved.skipped > 0)
      session.messages().add(MessageLevel::info, trfMany("{} of the places is taken: nothing was moved",
                                                         "{} of the places are taken: nothing was moved",
                                                         moved.skipped, moved.skipped));
    else if (session.apply(std::move(moved.edit)))
      state.selection = std::move(moved.cells);
  } else if (const auto* lattice = std::get_if<LatticeIntent>(&intent)) {
    session.apply(setLattice(project, lattice->place, LatticeTool::labelOf(*lattice)));
  } else if (const auto* pan = std::get_if<PanIntent>(&intent)) {
    view_.panPixels(pan->pixels);
  } else if (const auto* place = std::get_if<PlaceEyeIntent>(&intent)) {
    placeEye(place->position);
  } else if (const auto* turn = std::get_if<TurnEyeIntent>(&intent)) {
    WalkPose pose = state.walker.pose();
    pose.yawRadians = turn->yawRadians;
    state.walker.setPose(pose);
  } else if (const auto* outline = std::get_if<OutlineIntent>(&intent)) {
    session.applyLive(setOutline(project, outline->outline), outline->finished);
  } else if (const auto* path = std::get_if<PathIntent>(&intent)) {
    takePathIntent(context.actions, *path);
  } else if (const auto* apv = std::get_if<FreeApvIntent>(&intent)) {
    const int number = apv->number.value_or(nextFreeNumber(project.layout()));
    Edit edit = apv->number ? setFreeApv(project, number, apv->apv) : addFreeApv(project, apv->apv);
    if (!apv->finished)
      session.applyLive(std::move(edit), false);
    else if (session.apply(std::move(edit)))
      state.selection = {{number, 0, kFreeSlot}};
  }
}

PlanSituation PlanPanel::situation(PanelContext& context) const {
  const glm::dvec2 a = view_.worldFromScreen(view_.areaMin());
  const glm::dvec2 b = view_.worldFromScreen(view_.areaMin() + view_.areaSize());
  PlanSituation situation{&context.session().project().layout(),
                          &context.state().selection,
                          glm::dvec2(context.state().walker.pose().eye),
                          view_.pixelsPerMetre() / double(ui::interfaceScale()),
                          glm::min(a, b),
                          glm::max(a, b),
                          {},
                          pathSituation(context.actions)};
  constexpr double kGridPixels = 14;  // the finer of the grid's lines
  situation.targets = {snapCorners_, ui::niceStep(view_.pixelsPerMetre(), kGridPixels), {}};
  if (const auto walls = context.session().walls()) situation.targets.wallRadians = walls->directionRadians;
  return situation;
}

bool PlanPanel::contains(const glm::dvec2& screen) const {
  const bool covered = screen.x >= arrayLow_.x && screen.y >= arrayLow_.y && screen.x < arrayHigh_.x &&
                       screen.y < arrayHigh_.y;
  return view_.contains(screen) && !covered;
}

void PlanPanel::handleKey(PanelContext& context, const ui::InputEvent& event) {
  EditorState& state = context.state();
  PlanTool& tool = state.planTool;
  if (tool.mode() == PlanMode::outline &&
      (event.code == ui::key::enter || event.code == ui::key::keypadEnter))
    act(context, tool.closeOutline());
  if (event.code != ui::key::escape) return;
  if (tool.cancel())
    context.session().cancelLive();
  else if (state.array)
    state.array.reset();
  else if (tool.mode() == PlanMode::measure)
    tool.setMode(PlanMode::cells);
  else
    state.selection.clear(), state.walkSelection.pose.reset();
}

void PlanPanel::handleEvents(PanelContext& context) {
  using Kind = ui::InputEvent::Kind;
  PlanTool& tool = context.state().planTool;
  for (const ui::InputEvent& event : context.events) {
    const bool inside = contains(event.position) && !context.inputBlocked;
    if (event.kind == Kind::scroll && inside) view_.zoomAt(event.position, std::pow(1.18, event.scroll.y));
    const bool ours = context.state().centreView == View::plan && !context.inputBlocked;
    if (event.kind == Kind::keyPress && ours) handleKey(context, event);
    PointerEvent pointer{PointerEvent::Kind::move, event.code, event.modifiers, event.position,
                         view_.worldFromScreen(event.position)};
    if (event.kind == Kind::buttonPress && inside)
      pointer.kind = PointerEvent::Kind::press;
    else if (event.kind == Kind::buttonRelease && tool.capturing())
      pointer.kind = PointerEvent::Kind::release;
    else if (event.kind != Kind::move || !tool.capturing())
      continue;
    act(context, tool.handle(pointer, situation(context)));
  }
}

/// What was to be selected is selected once its figures are there.
void PlanPanel::fulfilWish(PanelContext& context) {
  EditorState& state = context.state();
  const auto inspection = context.session().inspection();
  if (state.selectionWish == SelectionWish::none || !inspection) return;
  const SelectionWish wish = std::exchange(state.selectionWish, SelectionWish::none);
  const auto most = std::size_t(context.session().project().budget.trianglesPerRegion);
  state.selection = wish == SelectionWish::withWarnings
                        ? withWarnings(*inspection->layout, inspection->placement)
                        : overBudget(*inspection->layout, inspection->budgets, most);
  if (state.selection.empty())
    context.session().messages().add(MessageLevel::good, wish == SelectionWish::withWarnings
                                                             ? tr("No cell has a warning")
                                                             : tr("No cell is over the budget"));
}

}  // namespace acentric::editor
