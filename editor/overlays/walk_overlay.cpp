#include "editor/overlays/walk_overlay.h"

#include <cmath>

#include "engine/geometry/conventions.h"
#include "engine/pipeline/walk_ground.h"
#include "ui/canvas_draw.h"
#include "ui/colour.h"

namespace acentric::editor {
namespace {

using ui::imVec;
namespace palette = ui::palette;

constexpr double kPosePixels = 4.5, kShortTickPixels = 13;

/// From a place on the plan, so many pixels in an azimuth.
glm::dvec2 towards(const glm::dvec2& screen, double azimuth, double pixels) {
  return screen + pixels * glm::dvec2(std::cos(azimuth), -std::sin(azimuth));
}

/// An arrow head in the middle of a stretch that has room for it.
void drawWay(ImDrawList& list, const glm::dvec2& from, const glm::dvec2& to, const ui::Colour& colour) {
  constexpr double kLeastPixels = 44, kHead = 6;
  const glm::dvec2 along = to - from;
  if (glm::length(along) < kLeastPixels) return;
  const double azimuth = std::atan2(-along.y, along.x);
  const glm::dvec2 tip = towards(0.5 * (from + to), azimuth, kHead / 2);
  list.AddTriangleFilled(imVec(tip), imVec(towards(tip, azimuth + 2.6, kHead + 2)),
                         imVec(towards(tip, azimuth - 2.6, kHead + 2)), colour.packed());
}

void drawLine(ImDrawList& list, const ui::CanvasView& view, const CameraPath& path, const ui::Colour& colour,
              float thickness) {
  for (std::size_t i = 0; i + 1 < path.poses.size(); ++i) {
    const glm::dvec2 from = view.screenFromWorld(glm::dvec2(path.poses[i].eye));
    const glm::dvec2 to = view.screenFromWorld(glm::dvec2(path.poses[i + 1].eye));
    list.AddLine(imVec(from), imVec(to), colour.packed(), thickness);
    drawWay(list, from, to, colour);
  }
}

void drawPose(ImDrawList& list, const ui::CanvasView& view, const PathPose& pose, bool first, bool selected,
              bool outside) {
  const glm::dvec2 at = view.screenFromWorld(glm::dvec2(pose.eye));
  const ui::Colour colour = outside ? palette::danger : kPathColour;
  const glm::dvec2 end = towards(at, pose.yawRadians, selected ? kTickPixels : kShortTickPixels);
  list.AddLine(imVec(at), imVec(end), colour.packed(), selected ? 2.0F : 1.4F);
  if (selected) {
    list.AddCircleFilled(imVec(end), 4.5F, palette::backdrop.packed());
    list.AddCircle(imVec(end), 4.5F, palette::text.packed(), 0, 1.6F);
  }
  const float radius = float(kPosePixels) + (first ? 1.5F : 0.0F);
  list.AddCircleFilled(imVec(at), radius + 1.5F, palette::backdrop.packed());
  list.AddCircleFilled(imVec(at), radius, selected ? palette::text.packed() : colour.packed());
  if (first) list.AddCircleFilled(imVec(at), 2.4F, palette::backdrop.packed());
  if (outside) list.AddCircle(imVec(at), radius + 4, colour.packed(), 0, 1.6F);
}

void drawHit(ImDrawList& list, const ui::CanvasView& view, const PathSituation& situation,
             const PathHit& hit) {
  const ImVec2 at = imVec(view.screenFromWorld(hit.place));
  const bool selected = situation.selection.number == hit.path;
  if (hit.kind == PathHit::Kind::pose || hit.kind == PathHit::Kind::tick) {
    list.AddCircle(at, 8.5F, palette::text.packed(), 0, 1.6F);
  } else if (hit.kind == PathHit::Kind::line && selected) {
    list.AddCircleFilled(at, 5.5F, palette::backdrop.packed());
    list.AddCircle(at, 5.5F, palette::text.packed(), 0, 1.6F);
    list.AddLine({at.x - 3, at.y}, {at.x + 3, at.y}, palette::text.packed(), 1.4F);
    list.AddLine({at.x, at.y - 3}, {at.x, at.y + 3}, palette::text.packed(), 1.4F);
  }
}

}  // namespace

void drawPaths(ImDrawList& list, const ui::CanvasView& view, const PathSituation& situation,
               const OpenProject& open, const glm::dvec2* pointer) {
  const WalkSelection& selection = situation.selection;
  for (std::size_t p = 0; p < situation.paths.size(); ++p) {
    const WalkPath& path = situation.paths[p];
    if (path.storey != situation.storey) continue;
    if (selection.kind != WalkSelection::Kind::path || selection.number != p) {
      drawLine(list, view, path.path, kPathColour.withOpacity(0.5F), 1.6F);
      continue;
    }
    drawLine(list, view, path.path, palette::backdrop.withOpacity(0.7F), 5);
    drawLine(list, view, path.path, kPathColour, 2.4F);
    for (std::size_t i = 0; i < path.path.poses.size(); ++i)
      drawPose(list, view, path.path.poses[i], i == 0, selection.pose == i,
               !open.ground->holds(path.storey, path.path.poses[i].eye));
  }
  if (pointer != nullptr)
    drawHit(list, view, situation, hitPaths(situation, *pointer, view.pixelsPerMetre()));
}

void drawBookmarks(ImDrawList& list, const ui::CanvasView& view, const Project& project,
                   const Bookmark* selected, ImFont* font) {
  constexpr std::size_t kMostNames = 12;
  for (const Bookmark& bookmark : project.bookmarks) {
    if (bookmark.storey != project.storey) continue;
    const glm::dvec2 at = view.screenFromWorld(glm::dvec2(bookmark.eye));
    if (!view.contains(at)) continue;
    const bool on = &bookmark == selected;
    const ui::Colour colour = on ? palette::text : kPathColour;
    list.AddLine(imVec(at), imVec(towards(at, bookmark.yawRadians, kShortTickPixels + 3)), colour.packed(),
                 1.6F);
    list.AddNgonFilled(imVec(at), 7, palette::backdrop.packed(), 4);
    list.AddNgonFilled(imVec(at), 5.5F, colour.packed(), 4);
    if (on || project.bookmarks.size() <= kMostNames)
      ui::drawLabel(list, font, {float(at.x) + 12, float(at.y) + 6}, colour, bookmark.name.c_str());
  }
}

}  // namespace acentric::editor
