/// What the user does in the plan: events go to its tools, their intentions become edits.

#include <cmath>
#include <utility>

#include "editor/actions/path_walk.h"
#include "editor/actions/plan_intents.h"
#include "editor/commands/selection.h"
#include "editor/panels/plan_panel.h"
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
  if (const auto* pan = std::get_if<PanIntent>(&intent)) return view_.panPixels(pan->pixels);
  takePlanIntent(context.actions, intent);
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
    const bool capturing = tool.capturing() && context.state().planToolView == View::plan;
    if (event.kind == Kind::buttonPress && inside) {
      if (!takeOver(context.actions, View::plan, event.code)) continue;
      pointer.kind = PointerEvent::Kind::press;
    } else if (event.kind == Kind::buttonRelease && capturing) {
      pointer.kind = PointerEvent::Kind::release;
    } else if (event.kind != Kind::move || !capturing) {
      continue;
    }
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
