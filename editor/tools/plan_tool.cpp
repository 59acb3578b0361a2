#include "editor/tools/plan_tool.h"

#include <cmath>
#include <utility>

#include "editor/commands/layout_edits.h"
#include "ui/keys.h"

namespace acentric::editor {
namespace {

PlanIntent asIntent(std::optional<OutlineIntent> intent) {
  return intent ? PlanIntent(std::move(*intent)) : PlanIntent();
}

PlanIntent asIntent(PanoramaIntent intent) {
  if (auto* apv = std::get_if<FreeApvIntent>(&intent)) return std::move(*apv);
  if (const auto* select = std::get_if<SelectApvIntent>(&intent))
    return SelectIntent{{{select->number, 0, kFreeSlot}}};
  if (const auto* remove = std::get_if<RemoveApvIntent>(&intent))
    return RemoveCellIntent{{remove->number, 0, kFreeSlot}};
  return {};
}

}  // namespace

void PlanTool::setMode(PlanMode mode) {
  cancel();
  mode_ = mode;
}

bool PlanTool::cancel() {
  const bool drawing = outline_.cancel(), placing = panorama_.cancel();
  const bool afoot = state_ != State::rest || drawing || placing;
  state_ = State::rest;
  drag_.reset();
  return afoot;
}

PlanIntent PlanTool::closeOutline() { return asIntent(outline_.close()); }

PlanIntent PlanTool::handle(const PointerEvent& event, const PlanSituation& situation) {
  switch (event.kind) {
    case PointerEvent::Kind::press:
      return press(event, situation);
    case PointerEvent::Kind::move:
      return move(event, situation);
    case PointerEvent::Kind::release:
      return release(event, situation);
  }
  return {};
}

PlanIntent PlanTool::press(const PointerEvent& event, const PlanSituation& situation) {
  if (state_ != State::rest) return {};  // a second button during a drag changes nothing
  button_ = event.button;
  pressScreen_ = lastScreen_ = event.screen;
  pressWorld_ = event.world;
  if (event.button != ui::mouse::left) {
    state_ = State::pan;
    return {};
  }
  if (mode_ == PlanMode::outline) {
    state_ = State::tool;
    return asIntent(outline_.press(event, situation.spec->outline, situation.pixelsPerMetre));
  }
  if (mode_ == PlanMode::panorama) {
    state_ = State::tool;
    return asIntent(panorama_.press(event, *situation.spec, situation.pixelsPerMetre));
  }
  if (mode_ == PlanMode::eye) {
    state_ = State::turnEye;
    return PlaceEyeIntent{event.world};
  }
  if (glm::distance(event.world, situation.eye) * situation.pixelsPerMetre <= kGrabPixels) {
    state_ = State::dragEye;
    return {};
  }
  const LatticeCell cell = cellAt(*situation.spec, event.world);
  pressed_ = cell.id;
  grabOffset_ = cell.polygon.centroid() - event.world;
  state_ = isPlaced(*situation.spec, cell.id) ? State::pressedCell : State::pressedFree;
  return {};
}

PlanIntent PlanTool::move(const PointerEvent& event, const PlanSituation& situation) {
  const bool dragged = glm::distance(event.screen, pressScreen_) > kDragPixels;
  const glm::dvec2 delta = event.screen - lastScreen_;
  switch (state_) {
    case State::rest:
      return {};
    case State::pan:
      lastScreen_ = event.screen;
      return PanIntent{delta};
    case State::pressedFree:
      if (!dragged) return {};
      state_ = State::pan;
      lastScreen_ = event.screen;
      return PanIntent{delta};
    case State::pressedCell:
      if (!dragged) return {};
      state_ = State::dragCell;
      [[fallthrough]];
    case State::dragCell:
      drag_ = CellDrag{pressed_, nearestSlot(*situation.spec, pressed_, event.world + grabOffset_)};
      return {};
    case State::tool:
      return mode_ == PlanMode::outline ? asIntent(outline_.move(event)) : asIntent(panorama_.move(event));
    case State::dragEye:
      return PlaceEyeIntent{event.world};
    case State::turnEye: {
      const glm::dvec2 away = event.world - pressWorld_;
      if (!dragged) return {};
      return TurnEyeIntent{std::atan2(away.y, away.x)};
    }
  }
  return {};
}

PlanIntent PlanTool::release(const PointerEvent& event, const PlanSituation& situation) {
  if (state_ == State::rest || event.button != button_) return {};
  const State state = std::exchange(state_, State::rest);
  const std::optional<CellDrag> drag = std::exchange(drag_, std::nullopt);
  if (state == State::dragCell && drag) {
    if (drag->from == drag->to || isPlaced(*situation.spec, drag->to)) return {};
    return MoveCellIntent{drag->from, drag->to};
  }
  if (state == State::pressedCell) return clickCell(event, situation);
  if (state == State::tool)
    return mode_ == PlanMode::outline ? asIntent(outline_.release(event, situation.pixelsPerMetre))
                                      : asIntent(panorama_.release(event));
  if (state != State::pressedFree) return {};
  return AddCellIntent{pressed_};
}

PlanIntent PlanTool::clickCell(const PointerEvent& event, const PlanSituation& situation) const {
  if ((event.modifiers & ui::modifier::control) != 0) return RemoveCellIntent{pressed_};
  if ((event.modifiers & ui::modifier::shift) == 0) return SelectIntent{{pressed_}};
  std::set<CellId> cells = *situation.selection;
  if (!cells.erase(pressed_)) cells.insert(pressed_);
  return SelectIntent{std::move(cells)};
}

}  // namespace acentric::editor
