#include "editor/tools/gizmo_subject.h"

#include <fmt/format.h>

#include <cmath>

#include "editor/commands/layout_edits.h"
#include "editor/commands/walk_edits.h"
#include "engine/geometry/conventions.h"
#include "engine/layout/layout.h"

namespace acentric::editor {
namespace {

glm::dvec2 rotated(const glm::dvec2& v, double angle) {
  const glm::dvec2 c = directionOf(angle);
  return {c.x * v.x - c.y * v.y, c.y * v.x + c.x * v.y};
}

double azimuthOf(const glm::dvec2& v) { return std::atan2(v.y, v.x); }

Edit withCorner(const Project& project, const CornerSubject& subject, const GizmoMove& move) {
  Outline outline = project.layout().outline;
  outline.loops[subject.corner.loop][subject.corner.corner] = subject.place + glm::dvec2(move.by);
  return setOutline(project, std::move(outline));
}

}  // namespace

std::optional<glm::dvec2> placeOf(const Outline& outline, const std::optional<OutlineCorner>& corner) {
  if (!corner || corner->loop >= outline.loops.size() || corner->corner >= outline.loops[corner->loop].size())
    return std::nullopt;
  return outline.loops[corner->loop][corner->corner];
}

std::optional<GizmoSubject> cellsSubject(const LayoutSpec& spec, const std::set<CellId>& cells) {
  if (cells.size() == 1 && cells.begin()->slot == kFreeSlot) {
    const auto found = spec.freeApvs.find(cells.begin()->i);
    if (found == spec.freeApvs.end()) return std::nullopt;
    return ApvSubject{found->first, found->second};
  }
  glm::dvec2 sum(0);
  int count = 0;
  for (const CellId& cell : cells) {
    if (!isPlaced(spec, cell)) continue;
    sum += cell.slot == kFreeSlot ? spec.freeApvs.at(cell.i).centre : cellPolygon(spec, cell).centroid();
    ++count;
  }
  if (count == 0) return std::nullopt;
  return CellsSubject{cells, sum / double(count)};
}

std::optional<GizmoSubject> cornerSubject(const LayoutSpec& spec,
                                          const std::optional<OutlineCorner>& corner) {
  const auto place = placeOf(spec.outline, corner);
  return place ? std::optional<GizmoSubject>(CornerSubject{*corner, *place}) : std::nullopt;
}

std::optional<GizmoSubject> poseSubject(const Project& project, const WalkSelection& selection) {
  const auto pose = selection.poseIn(project);
  if (!pose || project.paths[selection.number].storey != project.storey) return std::nullopt;
  return PoseSubject{selection.number, *pose, project.paths[selection.number].path.poses[*pose]};
}

Gizmo gizmoOf(const GizmoSubject& subject, const LayoutSpec& spec, double floor) {
  if (const auto* cells = std::get_if<CellsSubject>(&subject))
    return {{cells->middle, floor}, spec.rotationRadians, false, false, 0};
  if (const auto* apv = std::get_if<ApvSubject>(&subject))
    return {{apv->apv.centre, floor}, 0, false, !apv->apv.traditional(), azimuthOf(apv->apv.offset)};
  if (const auto* corner = std::get_if<CornerSubject>(&subject))
    return {{corner->place, floor}, 0, false, false, 0};
  const PathPose& pose = std::get<PoseSubject>(subject).was;
  return {pose.eye, 0, true, true, pose.yawRadians};
}

std::optional<Edit> edited(const GizmoSubject& subject, const Project& project, const GizmoMove& move) {
  if (const auto* of = std::get_if<ApvSubject>(&subject)) {
    if (!project.layout().freeApvs.contains(of->number)) return std::nullopt;
    Apv apv = of->apv;
    apv.centre += glm::dvec2(move.by);
    if (move.turnRadians != 0) apv.offset = rotated(apv.offset, move.turnRadians);
    return setFreeApv(project, of->number, apv);
  }
  if (const auto* corner = std::get_if<CornerSubject>(&subject))
    return placeOf(project.layout().outline, corner->corner)
               ? std::optional(withCorner(project, *corner, move))
               : std::nullopt;
  if (const auto* of = std::get_if<PoseSubject>(&subject)) {
    if (of->path >= project.paths.size() || of->pose >= project.paths[of->path].path.poses.size())
      return std::nullopt;
    CameraPath path = project.paths[of->path].path;
    PathPose& pose = path.poses[of->pose];
    pose.eye = of->was.eye + move.by;
    if (move.turnRadians != 0) pose.yawRadians = wrapAngle(of->was.yawRadians + move.turnRadians);
    return setPath(project, of->path, std::move(path));
  }
  return std::nullopt;
}

}  // namespace acentric::editor
