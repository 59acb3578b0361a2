#include "editor/tools/plan_tool.h"

#include <cmath>
#include <utility>

#include "ui/keys.h"

namespace acentric::editor {
namespace {

PlanIntent asIntent(std::optional<OutlineIntent> intent) {
  return intent ? PlanIntent(std::move(*intent)) : PlanIntent();
}

PlanIntent asIntent(std::optional<PathIntent> intent) {
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
  const bool drawing = outline_.cancel(), placing = panorama_.cancel(), laying = lattice_.cancel(),
             measuring = measure_.cancel(), changing = path_.cancel(), painting = density_.cancel();
  const bool afoot =
      state_ != State::rest || drawing || placing || laying || measuring || changing || painting;
  state_ = State::rest;
  drag_.reset();
  return afoot;
}

PlanIntent PlanTool::closeOutline() { return asIntent(outline_.close()); }

std::optional<MarqueeIntent> PlanTool::marquee() const {
  if (state_ != State::marquee) return std::nullopt;
  return MarqueeIntent{glm::min(pressWorld_, lastWorld_), glm::max(pressWorld_, lastWorld_),
                       (modifiers_ & ui::modifier::control) != 0 ? Combine::toggle : Combine::add};
}

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

/// Nothing: the press is none of the tool's.
std::optional<PlanIntent> PlanTool::pressTool(const PointerEvent& event, const PlanSituation& situation) {
  const LayoutSpec& spec = *situation.spec;
  switch (mode_) {
    case PlanMode::outline:
      return asIntent(outline_.press(event, spec.outline, situation.pixelsPerMetre));
    case PlanMode::panorama:
      return asIntent(panorama_.press(event, spec, situation.pixelsPerMetre));
    case PlanMode::measure:
      measure_.press(event, spec, situation.targets, situation.pixelsPerMetre);
      return PlanIntent();
    case PlanMode::lattice:
      if (lattice_.press(
              event, spec,
              latticeHandles(spec, situation.viewLow, situation.viewHigh, situation.pixelsPerMetre),
              situation.pixelsPerMetre))
        return PlanIntent();
      break;
    case PlanMode::path:
      if (auto intent = path_.press(event, situation.paths, situation.pixelsPerMetre))
        return PlanIntent(std::move(*intent));
      break;
    case PlanMode::density:
      density_.press(event, spec);
      return PlanIntent();
    case PlanMode::cells:
    case PlanMode::eye:
      break;
  }
  return std::nullopt;
}

PlanIntent PlanTool::press(const PointerEvent& event, const PlanSituation& situation) {
  if (state_ != State::rest) return {};  // a second button during a drag changes nothing
  button_ = event.button;
  modifiers_ = event.modifiers;
  pressScreen_ = lastScreen_ = event.screen;
  pressWorld_ = lastWorld_ = event.world;
  if (event.button != ui::mouse::left) {
    state_ = State::pan;
    return {};
  }
  if (mode_ == PlanMode::eye) {
    state_ = State::turnEye;
    return PlaceEyeIntent{event.world};
  }
  if (mode_ != PlanMode::cells) {
    auto intent = pressTool(event, situation);
    state_ = intent ? State::tool : State::pan;
    if (intent) return std::move(*intent);
    return mode_ == PlanMode::path ? PlanIntent(PathIntent{}) : PlanIntent();
  }
  if (glm::distance(event.world, situation.eye) * situation.pixelsPerMetre <= kGrabPixels) {
    state_ = State::dragEye;
    return {};
  }
  pressed_ = cellAt(*situation.spec, event.world).id;
  state_ = isPlaced(*situation.spec, pressed_) ? State::pressedCell : State::pressedFree;
  return {};
}

PlanIntent PlanTool::moveTool(const PointerEvent& event, const PlanSituation& situation) {
  switch (mode_) {
    case PlanMode::outline:
      return asIntent(outline_.move(event));
    case PlanMode::panorama:
      return asIntent(panorama_.move(event));
    case PlanMode::lattice:
      lattice_.move(event, situation.targets, situation.pixelsPerMetre);
      break;
    case PlanMode::measure:
      measure_.move(event, *situation.spec, situation.targets, situation.pixelsPerMetre);
      break;
    case PlanMode::path:
      return asIntent(path_.move(event));
    case PlanMode::density:
      density_.move(event, *situation.spec);
      break;
    case PlanMode::cells:
    case PlanMode::eye:
      break;
  }
  return {};
}

/// What was a press turns out to be a drag.
PlanIntent PlanTool::beginDrag(const PointerEvent& event, const PlanSituation& situation) {
  constexpr int kSelects = ui::modifier::shift | ui::modifier::control;
  lastWorld_ = event.world;
  if ((modifiers_ & kSelects) != 0) {
    state_ = State::marquee;
    return {};
  }
  if (state_ == State::pressedFree) {
    state_ = State::pan;
    return PanIntent{event.screen - std::exchange(lastScreen_, event.screen)};
  }
  std::set<CellId> cells{pressed_};
  if (situation.selection->contains(pressed_)) cells = *situation.selection;
  CellGroup group(*situation.spec, cells);
  const LatticeStep step = group.nearestStep(event.world - pressWorld_);
  drag_.emplace(CellDrag{std::move(cells), std::move(group), step});
  state_ = State::dragCell;
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
    case State::pressedCell:
      return dragged ? beginDrag(event, situation) : PlanIntent();
    case State::dragCell:
      drag_->step = drag_->group.nearestStep(event.world - pressWorld_);
      return {};
    case State::marquee:
      lastWorld_ = event.world;
      return {};
    case State::tool:
      return moveTool(event, situation);
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

PlanIntent PlanTool::releaseTool(const PointerEvent& event, const PlanSituation& situation) {
  switch (mode_) {
    case PlanMode::outline:
      return asIntent(outline_.release(event, situation.pixelsPerMetre));
    case PlanMode::panorama:
      return asIntent(panorama_.release(event));
    case PlanMode::lattice:
      if (auto intent = lattice_.release(event, situation.targets, situation.pixelsPerMetre)) return *intent;
      break;
    case PlanMode::measure:
      measure_.release();
      break;
    case PlanMode::path:
      return asIntent(path_.release(event));
    case PlanMode::density:
      return density_.release();
    case PlanMode::cells:
    case PlanMode::eye:
      break;
  }
  return {};
}

PlanIntent PlanTool::release(const PointerEvent& event, const PlanSituation& situation) {
  if (state_ == State::rest || event.button != button_) return {};
  lastWorld_ = event.world;
  const std::optional<MarqueeIntent> box = marquee();
  const State state = std::exchange(state_, State::rest);
  std::optional<CellDrag> drag = std::exchange(drag_, std::nullopt);
  if (box) return *box;
  if (state == State::dragCell && drag) {
    if (drag->step == LatticeStep{}) return {};
    return MoveCellsIntent{std::move(drag->cells), drag->step};
  }
  if (state == State::pressedCell) return clickCell(event, situation);
  if (state == State::tool) return releaseTool(event, situation);
  if (state != State::pressedFree || modifiers_ != 0) return {};
  return AddCellIntent{pressed_};
}

PlanIntent PlanTool::clickCell(const PointerEvent& event, const PlanSituation& situation) const {
  const bool toggles = (event.modifiers & ui::modifier::control) != 0;
  if (!toggles && (event.modifiers & ui::modifier::shift) == 0) return SelectIntent{{pressed_}};
  return SelectIntent{combined(*situation.selection, {pressed_}, toggles ? Combine::toggle : Combine::add)};
}

}  // namespace acentric::editor
