#include "editor/actions/scene_editing.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "editor/actions/path_walk.h"
#include "editor/actions/plan_intents.h"
#include "editor/tools/orbit_camera.h"
#include "editor/tools/scene_hits.h"
#include "ui/canvas_view.h"
#include "ui/keys.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

constexpr int kSelects = ui::modifier::shift | ui::modifier::control;

double floorOf(const ActionContext& c) { return latticeHeight(c.session.project().layout()); }

bool editable(const ActionContext& c) {
  return c.session.hasProject() && c.session.built() && !c.session.shippedWalk();
}

/// Keeps the height of what is drawn nearest.
struct NearestLevel {
  double pixels;
  double level;
  void offer(double away, double z) {
    if (away < pixels) pixels = away, level = z;
  }
};

/// The height that the path tool works on: that of the line or key pose that is drawn near the pixel, else
/// that of the selected path's end, else the eyes'.
double pathLevel(const ActionContext& c, const glm::dvec2& pixel, const SceneSight& sight) {
  const LayoutSpec& spec = c.session.project().layout();
  NearestLevel nearest{2 * kGrabPixels * sight.scale, spec.floorHeight + spec.eyeHeight};
  const PathSituation paths = pathSituation(c);
  if (const WalkPath* walk = paths.selection.path(c.session.project());
      walk != nullptr && walk->storey == paths.storey && !walk->path.poses.empty())
    nearest.level = walk->path.poses.back().eye.z;  // what is appended is as high
  for (const WalkPath& walk : paths.paths) {
    if (walk.storey != paths.storey) continue;
    const std::vector<PathPose>& poses = walk.path.poses;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const Projected seen = project(sight.view, poses[i].eye);
      // Poses before lines, which end at them.
      if (seen.depth > 0) nearest.offer(0.9 * glm::distance(seen.pixel, pixel) - 1, poses[i].eye.z);
      if (i + 1 == poses.size()) continue;
      double share = 0;
      if (const auto line = strokeOf(sight.view, poses[i].eye, poses[i + 1].eye))
        nearest.offer(distanceTo(*line, pixel, &share), glm::mix(poses[i].eye.z, poses[i + 1].eye.z, share));
    }
  }
  if (const auto pose = poseSubject(c.session.project(), c.state.walkSelection)) {
    const PathPose& of = std::get<PoseSubject>(*pose).was;
    if (const double scale = pixelsPerMetre(sight.view, of.eye) / sight.scale; scale > 0) {
      const glm::dvec3 tick = of.eye + glm::dvec3(kTickPixels / scale * directionOf(of.yawRadians), 0);
      const Projected seen = project(sight.view, tick);
      if (seen.depth > 0) nearest.offer(0.9 * glm::distance(seen.pixel, pixel) - 1, of.eye.z);
    }
  }
  return nearest.level;
}

double levelUnder(const ActionContext& c, const glm::dvec2& pixel, const SceneSight& sight) {
  return c.state.planTool.mode() == PlanMode::path ? pathLevel(c, pixel, sight) : floorOf(c);
}

/// Does a press with the left button belong to the plan's tool?
bool toolTakes(const ActionContext& c, int modifiers) {
  return c.state.planTool.mode() != PlanMode::cells || c.state.scene3d.placing || (modifiers & kSelects) != 0;
}

/// The corner that the outline tool's press is about to take hold of.
std::optional<OutlineCorner> cornerPressed(const LayoutSpec& spec, const glm::dvec2& place,
                                           double pixelsPerMetre, int modifiers) {
  const OutlineHit hit = hitOutline(spec.outline, place, pixelsPerMetre);
  if (hit.kind == OutlineHit::Kind::nothing || (modifiers & ui::modifier::control) != 0) return std::nullopt;
  return OutlineCorner{hit.loop, hit.kind == OutlineHit::Kind::side ? hit.corner + 1 : hit.corner};
}

void keepOnly(EditorState& state, const std::optional<OutlineCorner>& corner, bool pose) {
  state.scene3d.corner = corner;
  if (!pose) state.walkSelection.pose.reset();
}

}  // namespace

SnapTargets SceneEditing::targets(const ActionContext& c, double pixelsPerMetre) {
  constexpr double kGridPixels = 14;  // the finer of the plan's grid lines
  const auto walls = c.session.walls();
  corners_.clear();
  if (walls) corners_ = walls->corners;
  for (const auto& loop : c.session.project().layout().outline.loops)
    corners_.insert(corners_.end(), loop.begin(), loop.end());
  SnapTargets targets{corners_, ui::niceStep(std::max(pixelsPerMetre, 1e-6), kGridPixels), {}};
  if (walls) targets.wallRadians = walls->directionRadians;
  return targets;
}

PlanSituation SceneEditing::situation(const ActionContext& c, const glm::dvec3& place,
                                      const SceneSight& sight) {
  // The lattice's handles stay where they are while the pointer moves: of one size for the whole view.
  const bool lattice = c.state.planTool.mode() == PlanMode::lattice;
  const glm::dvec2 focus(sight.focus);
  const glm::dvec3 at = lattice ? glm::dvec3(focus, floorOf(c)) : place;
  const double scale = std::max(pixelsPerMetre(sight.view, at) / sight.scale, 1e-6);
  const double reach = 0.3 * glm::distance(sight.focus, sight.view.eye);
  // A press near the eye drags it only where cells are placed.
  const bool eye = c.state.planTool.mode() != PlanMode::cells || c.state.scene3d.placing;
  const double kFar = 1e9;
  return {&c.session.project().layout(),
          &c.state.selection,
          eye ? glm::dvec2(c.state.walker.pose().eye) : glm::dvec2(kFar),
          scale,
          focus - reach,
          focus + reach,
          targets(c, scale),
          pathSituation(c)};
}

std::optional<glm::dvec3> SceneEditing::placeUnder(const ActionContext& c, const glm::dvec2& pixel,
                                                   const SceneSight& sight) const {
  const double level = capturing(c) ? level_ : levelUnder(c, pixel, sight);
  const auto place = onLevel(rayThrough(sight.view, pixel), level);
  return place ? std::optional(glm::dvec3(*place, level)) : std::nullopt;
}

bool SceneEditing::capturing(const ActionContext& c) const {
  return gizmoTool_.capturing() || (c.state.planTool.capturing() && c.state.planToolView == View::scene3d);
}

bool SceneEditing::cancel(ActionContext& c) {
  const bool held = gizmoTool_.cancel();
  subject_.reset();
  cells_.reset();
  const bool ours = c.state.planToolView == View::scene3d || !c.state.planTool.capturing();
  const bool afoot = (ours && c.state.planTool.cancel()) || held;
  if (afoot) c.session.cancelLive();
  return afoot;
}

std::optional<SceneIntent> SceneEditing::handle(ActionContext& c, const ScenePointer& event,
                                                const SceneSight& sight) {
  if (!editable(c)) return std::nullopt;
  const bool captured = capturing(c);
  switch (event.kind) {
    case ScenePointer::Kind::press:
      // A second button during a drag changes nothing.
      return captured ? std::optional<SceneIntent>(SceneIntent{}) : press(c, event, sight);
    case ScenePointer::Kind::move:
      if (!captured) return std::nullopt;
      if (!gizmoTool_.capturing()) return tell(c, PointerEvent::Kind::move, event, sight);
      dragGizmo(c, event, sight);
      return SceneIntent{};
    case ScenePointer::Kind::release:
      if (!captured) return std::nullopt;
      if (!gizmoTool_.capturing()) return tell(c, PointerEvent::Kind::release, event, sight);
      if (event.button != ui::mouse::left) return SceneIntent{};
      dragGizmo(c, event, sight);
      letGo(c);
      return SceneIntent{};
  }
  return std::nullopt;
}

std::optional<SceneIntent> SceneEditing::press(ActionContext& c, const ScenePointer& event,
                                               const SceneSight& sight) {
  const bool looks = (event.modifiers & ui::modifier::alt) != 0 || c.state.scene3d.picking;
  if (event.button != ui::mouse::left || looks) return std::nullopt;
  const auto found = subject(c);
  const bool takesAway = (event.modifiers & ui::modifier::control) != 0;  // the tool's
  if (found && !takesAway) {
    const Gizmo shown = gizmoOf(*found, c.session.project().layout(), floorOf(c));
    if (gizmoTool_.press(event.pixel, sight.view, shown, sight.scale)) {
      takeHold(c, *found, shown);
      return SceneIntent{};
    }
  }
  if (!toolTakes(c, event.modifiers)) return std::nullopt;
  level_ = levelUnder(c, event.pixel, sight);
  const auto place = onLevel(rayThrough(sight.view, event.pixel), level_);
  if (!place) return std::nullopt;
  if (c.state.planTool.mode() == PlanMode::outline) {
    const PlanSituation now = situation(c, {*place, level_}, sight);
    c.state.scene3d.corner = c.state.planTool.outlineTool().corners().empty()
                                 ? cornerPressed(*now.spec, *place, now.pixelsPerMetre, event.modifiers)
                                 : std::nullopt;
  }
  takeOver(c, View::scene3d, event.button);
  return tell(c, PointerEvent::Kind::press, event, sight);
}

/// The plan's tool is told of an event, at the place on its level.
std::optional<SceneIntent> SceneEditing::tell(ActionContext& c, PointerEvent::Kind kind,
                                              const ScenePointer& event, const SceneSight& sight) {
  lastPlace_ = onLevel(rayThrough(sight.view, event.pixel), level_).value_or(lastPlace_);
  PlanTool& tool = c.state.planTool;
  const bool selects = kind == PointerEvent::Kind::release && tool.mode() == PlanMode::cells &&
                       !c.state.scene3d.placing && !tool.marquee() && !tool.cellDrag();
  const PlanIntent intent = tool.handle({kind, event.button, event.modifiers, event.pixel, lastPlace_},
                                        situation(c, {lastPlace_, level_}, sight));
  if (const auto* pan = std::get_if<PanIntent>(&intent)) return SceneIntent{OrbitIntent{pan->pixels}};
  if (selects) {
    const bool toggles = (event.modifiers & ui::modifier::control) != 0;
    return SceneIntent{SelectAtIntent{event.pixel, toggles ? Combine::toggle : Combine::add}};
  }
  takePlanIntent(c, intent);
  return SceneIntent{};
}

std::optional<GizmoSubject> SceneEditing::subject(const ActionContext& c) {
  if (!editable(c)) return std::nullopt;
  const Project& project = c.session.project();
  const PlanMode mode = c.state.planTool.mode();
  if (mode == PlanMode::path) return poseSubject(project, c.state.walkSelection);
  if (mode == PlanMode::outline) return cornerSubject(project.layout(), c.state.scene3d.corner);
  if (mode != PlanMode::cells && mode != PlanMode::panorama) return std::nullopt;
  if (!c.state.selection.empty()) {
    if (specAsked_ != project.layout() || cellsAsked_ != c.state.selection) {
      specAsked_ = project.layout();
      cellsAsked_ = c.state.selection;
      cellsFound_ = cellsSubject(*specAsked_, cellsAsked_);
    }
    return cellsFound_;
  }
  if (auto pose = poseSubject(project, c.state.walkSelection); pose && c.state.showPaths) return pose;
  return cornerSubject(project.layout(), c.state.scene3d.corner);
}

std::optional<Gizmo> SceneEditing::gizmo(const ActionContext& c) {
  if (gizmoTool_.capturing()) {
    GizmoMove move = gizmoTool_.now();
    if (cells_) move.by = glm::dvec3(cells_->group.metresOf(cells_->step), 0);
    return moved(held_, move);
  }
  if (capturing(c)) return std::nullopt;
  const auto found = subject(c);
  if (!found) return std::nullopt;
  return gizmoOf(*found, c.session.project().layout(), floorOf(c));
}

void SceneEditing::takeHold(ActionContext& c, const GizmoSubject& subject, const Gizmo& gizmo) {
  subject_ = subject;
  held_ = gizmo;
  cells_.reset();
  if (const auto* of = std::get_if<CellsSubject>(&subject))
    cells_ = CellsOnTheirWay{CellGroup(c.session.project().layout(), of->cells), {}};
}

void SceneEditing::dragGizmo(ActionContext& c, const ScenePointer& event, const SceneSight& sight) {
  const double scale = pixelsPerMetre(sight.view, held_.at) / sight.scale;
  if (!gizmoTool_.move(event.pixel, sight.view, event.modifiers, targets(c, scale), sight.scale)) return;
  if (cells_)
    cells_->step = cells_->group.nearestStep(glm::dvec2(gizmoTool_.now().by));
  else if (auto edit = edited(*subject_, c.session.project(), gizmoTool_.now()))
    c.session.applyLive(*std::move(edit), false);
}

void SceneEditing::letGo(ActionContext& c) {
  const auto move = gizmoTool_.release();
  const auto subject = std::exchange(subject_, std::nullopt);
  const auto cells = std::exchange(cells_, std::nullopt);
  if (cells) {
    if (move && cells->step != LatticeStep{})
      moveSelected(c, std::get<CellsSubject>(*subject).cells, cells->step);
    return;
  }
  auto edit = move ? edited(*subject, c.session.project(), *move) : std::nullopt;
  if (!edit) return c.session.cancelLive();
  c.session.applyLive(*std::move(edit), true);
}

std::string SceneEditing::text(const ActionContext& c) const {
  if (gizmoTool_.capturing()) {
    const GizmoMove& move = gizmoTool_.now();
    if (!cells_) {
      const Gizmo at = moved(held_, move);
      if (gizmoTool_.grip() == GizmoGrip::turn)
        return fmt::format("{}, to {:.1f}°", gizmoTool_.text(), degrees(at.yawRadians));
      if (gizmoTool_.grip() == GizmoGrip::up)
        return fmt::format("{}, to {:.3f} m", gizmoTool_.text(), at.at.z);
      return fmt::format("{}, to ({:.3f}, {:.3f})", gizmoTool_.text(), at.at.x, at.at.y);
    }
    const glm::dvec2 by = cells_->group.metresOf(cells_->step);
    std::string words = fmt::format("x {:+.3f} m   y {:+.3f} m", by.x, by.y);
    if (cells_->step != LatticeStep{} && !cells_->group.fits(cells_->step, true))
      words += std::string(", ") + tr("places taken");
    return words;
  }
  const PlanTool& tool = c.state.planTool;
  if (tool.latticeTool().dragging()) return tool.latticeTool().text();
  if (tool.mode() == PlanMode::measure && tool.measureTool().ruler())
    return describe(*tool.measureTool().ruler());
  return {};
}

void SceneEditing::select(ActionContext& c, const SelectAtIntent& at, const std::optional<CellId>& cell,
                          const SceneSight& sight) const {
  EditorState& state = c.state;
  const Project& project = c.session.project();
  const double floor = floorOf(c);
  double nearest = kGrabPixels * sight.scale;
  const auto nearer = [&](const glm::dvec3& place) {
    const Projected seen = acentric::editor::project(sight.view, place);
    const double away = glm::distance(seen.pixel, at.pixel);
    return seen.depth > 0 && away < nearest && (nearest = away, true);
  };
  std::optional<CellId> chosen = cell;
  std::optional<OutlineCorner> corner;
  std::optional<std::size_t> pose;
  for (const auto& [number, apv] : project.layout().freeApvs)
    if (nearer({apv.centre, floor})) chosen = CellId{number, 0, kFreeSlot};
  if (at.how == Combine::replace && !c.session.shippedWalk()) {
    const auto& loops = project.layout().outline.loops;
    for (std::size_t l = 0; l < loops.size(); ++l)
      for (std::size_t k = 0; k < loops[l].size(); ++k)
        if (nearer({loops[l][k], floor})) corner = OutlineCorner{l, k};
    const WalkPath* path = state.showPaths ? state.walkSelection.path(project) : nullptr;
    if (path != nullptr && path->storey == project.storey)
      for (std::size_t i = 0; i < path->path.poses.size(); ++i)
        if (nearer(path->path.poses[i].eye)) pose = i;
  }
  if (corner || pose) {
    state.selection.clear();
    keepOnly(state, pose ? std::nullopt : corner, pose.has_value());
    if (pose) state.walkSelection.pose = pose;
    return;
  }
  keepOnly(state, std::nullopt, false);
  if (at.how == Combine::replace) state.selection.clear();
  if (chosen) state.selection = combined(state.selection, {*chosen}, at.how);
}

}  // namespace acentric::editor
