#include "editor/tools/path_tool.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "editor/commands/walk_edits.h"
#include "editor/tools/walker.h"
#include "ui/keys.h"

namespace acentric::editor {
namespace {

/// How far along the way from `a` to `b` its point nearest to `point` is, 0..1.
double nearestShare(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& point) {
  const glm::dvec2 along = b - a;
  const double length2 = glm::dot(along, along);
  return length2 > 0 ? std::clamp(glm::dot(point - a, along) / length2, 0.0, 1.0) : 0;
}

/// Keeps the nearest of what is offered.
struct Nearest {
  double distance;
  PathHit hit;
  void offer(const PathHit& other, double otherDistance) {
    if (otherDistance < distance) distance = otherDistance, hit = other;
  }
};

void offerPoses(Nearest& nearest, std::size_t number, const CameraPath& path, const glm::dvec2& point) {
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    const glm::dvec2 place(path.poses[i].eye);
    nearest.offer({PathHit::Kind::pose, number, i, path.poses[i].seconds, place},
                  glm::distance(place, point));
  }
}

void offerLines(Nearest& nearest, std::size_t number, const CameraPath& path, const glm::dvec2& point) {
  for (std::size_t i = 0; i + 1 < path.poses.size(); ++i) {
    const PathPose &from = path.poses[i], &to = path.poses[i + 1];
    const PathPose at = between(from, to, nearestShare(glm::dvec2(from.eye), glm::dvec2(to.eye), point));
    nearest.offer({PathHit::Kind::line, number, i, at.seconds, glm::dvec2(at.eye)},
                  glm::distance(glm::dvec2(at.eye), point));
  }
}

}  // namespace

PathHit hitPaths(const PathSituation& situation, const glm::dvec2& point, double pixelsPerMetre) {
  const double reach = kGrabPixels / pixelsPerMetre;
  const WalkSelection& selection = situation.selection;
  const bool selected =
      selection.kind == WalkSelection::Kind::path && selection.number < situation.paths.size();
  if (selected && selection.pose && *selection.pose < situation.paths[selection.number].path.poses.size()) {
    const PathPose& pose = situation.paths[selection.number].path.poses[*selection.pose];
    const glm::dvec2 end = glm::dvec2(pose.eye) + kTickPixels / pixelsPerMetre * directionOf(pose.yawRadians);
    if (situation.paths[selection.number].storey == situation.storey && glm::distance(end, point) <= reach)
      return {PathHit::Kind::tick, selection.number, *selection.pose, pose.seconds, end};
  }
  for (const auto offer : {offerPoses, offerLines}) {
    Nearest nearest{reach, {}};
    // The selected one first: others have to be nearer than it.
    if (selected && situation.paths[selection.number].storey == situation.storey)
      offer(nearest, selection.number, situation.paths[selection.number].path, point);
    for (std::size_t p = 0; p < situation.paths.size(); ++p)
      if (situation.paths[p].storey == situation.storey) offer(nearest, p, situation.paths[p].path, point);
    if (nearest.hit.kind != PathHit::Kind::nothing) return nearest.hit;
  }
  return {};
}

PathIntent PathTool::changedTo(bool finished) const {
  return {drag_->path, drag_->pose, drag_->changed, finished};
}

/// A key pose at the end of the selected path; nothing where none of the storey's is selected.
std::optional<PathIntent> PathTool::append(const PointerEvent& event, const PathSituation& situation) {
  const WalkSelection& selected = situation.selection;
  const bool any = selected.kind == WalkSelection::Kind::path && selected.number < situation.paths.size() &&
                   situation.paths[selected.number].storey == situation.storey;
  if (!any || (event.modifiers & ui::modifier::shift) == 0) return std::nullopt;
  const CameraPath& path = situation.paths[selected.number].path;
  CameraPath changed = withPoseAfter(path, event.world, Walker::kMetresPerSecond);
  if (changed == path) return std::nullopt;
  const std::size_t last = changed.poses.size() - 1;
  drag_ = Drag{selected.number, last, std::move(changed), glm::dvec2(0), false, true};
  return changedTo(false);
}

std::optional<PathIntent> PathTool::press(const PointerEvent& event, const PathSituation& situation,
                                          double pixelsPerMetre) {
  const PathHit hit = hitPaths(situation, event.world, pixelsPerMetre);
  pressScreen_ = event.screen;
  if (hit.kind == PathHit::Kind::nothing) return append(event, situation);
  const CameraPath& path = situation.paths[hit.path].path;
  const bool isSelected =
      situation.selection.kind == WalkSelection::Kind::path && situation.selection.number == hit.path;
  if (hit.kind == PathHit::Kind::line) {
    if (!isSelected) return PathIntent{hit.path, std::nullopt, std::nullopt, true};
    auto [changed, pose] = withPoseAt(path, hit.seconds);
    const bool added = changed != path;
    drag_ = Drag{hit.path, pose, std::move(changed), hit.place - event.world, false, added};
    return added ? changedTo(false) : PathIntent{hit.path, pose, std::nullopt, true};
  }
  if (hit.kind == PathHit::Kind::pose && (event.modifiers & ui::modifier::control) != 0)
    return PathIntent{hit.path, std::nullopt, withoutPose(path, hit.pose), true};
  drag_ = Drag{hit.path, hit.pose, path, hit.place - event.world, hit.kind == PathHit::Kind::tick, false};
  return PathIntent{hit.path, hit.pose, std::nullopt, true};
}

std::optional<PathIntent> PathTool::move(const PointerEvent& event) {
  if (!drag_ || (!drag_->moved && glm::distance(event.screen, pressScreen_) <= kDragPixels))
    return std::nullopt;
  drag_->moved = true;
  PathPose& pose = drag_->changed.poses[drag_->pose];
  if (drag_->turning) {
    const glm::dvec2 away = event.world - glm::dvec2(pose.eye);
    if (away != glm::dvec2(0)) pose.yawRadians = wrapAngle(std::atan2(away.y, away.x));
  } else {
    pose.eye = glm::dvec3(event.world + drag_->offset, pose.eye.z);
  }
  return changedTo(false);
}

std::optional<PathIntent> PathTool::release(const PointerEvent& event) {
  if (!drag_) return std::nullopt;
  move(event);
  const std::optional<PathIntent> last = drag_->moved ? std::optional(changedTo(true)) : std::nullopt;
  drag_.reset();
  return last;
}

bool PathTool::cancel() {
  const bool afoot = drag_.has_value();
  drag_.reset();
  return afoot;
}

}  // namespace acentric::editor
