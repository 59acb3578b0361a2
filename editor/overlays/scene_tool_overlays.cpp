#include "editor/overlays/scene_tool_overlays.h"

#include <array>
#include <cmath>

#include "editor/overlays/walk_overlay.h"
#include "engine/geometry/conventions.h"
#include "engine/pipeline/walk_ground.h"
#include "ui/canvas_draw.h"
#include "ui/theme.h"

namespace acentric::editor {
namespace {

namespace palette = ui::palette;

constexpr ui::Colour kFirst = ui::Colour::hex(0xff6f61), kSecond = ui::Colour::hex(0x7ed957),
                     kUpright = ui::Colour::hex(0x5fb2ff), kRing = ui::Colour::hex(0xffd45e);

ui::Colour colourOf(GizmoGrip grip) {
  switch (grip) {
    case GizmoGrip::x:
      return kFirst;
    case GizmoGrip::y:
      return kSecond;
    case GizmoGrip::up:
      return kUpright;
    case GizmoGrip::turn:
    case GizmoGrip::plane:
    case GizmoGrip::none:
      break;
  }
  return kRing;
}

void drawHead(ImDrawList& list, const ImVec2& from, const ImVec2& to, const ui::Colour& colour, float grown) {
  const float x = to.x - from.x, y = to.y - from.y, length = std::hypot(x, y);
  if (length <= 0) return;
  const float long_ = ui::scaled(13) + 2 * grown, half = ui::scaled(5.5F) + grown;
  const ImVec2 way(x / length, y / length),
      tip(to.x + way.x * (ui::scaled(4) + grown), to.y + way.y * (ui::scaled(4) + grown));
  const ImVec2 foot(tip.x - way.x * long_, tip.y - way.y * long_);
  list.AddTriangleFilled(tip, {foot.x - way.y * half, foot.y + way.x * half},
                         {foot.x + way.y * half, foot.y - way.x * half}, colour.packed());
}

void drawPart(const SceneInk& ink, const GizmoPart& part, const ui::Colour& colour, float thickness,
              float grown) {
  ImDrawList& list = ink.list();
  std::vector<ImVec2> points;
  for (const glm::dvec2& pixel : part.pixels) points.push_back(ink.onWindow(pixel));
  if (points.size() < 2) return;
  const bool square = part.grip == GizmoGrip::plane;
  if (square && grown == 0)
    list.AddConvexPolyFilled(points.data(), int(points.size()), colour.withOpacity(0.35F).packed());
  list.AddPolyline(points.data(), int(points.size()), colour.packed(), square ? ImDrawFlags_Closed : 0,
                   thickness + 2 * grown);
  if (!square && part.grip != GizmoGrip::turn) drawHead(list, points.front(), points.back(), colour, grown);
}

void drawPose(const SceneInk& ink, const PathPose& pose, bool first, bool selected, bool outside) {
  const ui::Colour colour = outside ? ui::Colour(palette::danger) : kPathColour;
  const double pixels = pixelsPerMetre(ink.view(), pose.eye) / double(ui::interfaceScale());
  if (pixels <= 0) return;
  const double length = (selected ? kTickPixels : kTickPixels / 2) / pixels;
  const glm::dvec3 tick = pose.eye + glm::dvec3(length * directionOf(pose.yawRadians), 0);
  ink.line(pose.eye, tick, colour, selected ? 2.0F : 1.4F);
  if (selected) ink.dot(tick, palette::text, 3.5F);
  ink.dot(pose.eye, selected ? ui::Colour(palette::text) : colour, first ? 6.0F : 4.5F);
}

}  // namespace

void drawGizmo(const SceneInk& ink, const Gizmo& gizmo, GizmoGrip lit) {
  const double scale = double(ui::interfaceScale());
  const std::vector<GizmoPart> parts = partsOf(gizmo, ink.view(), scale);
  const ui::Colour rim = ui::Colour::hex(0x000000, 0.7F);
  for (const GizmoPart& part : parts) drawPart(ink, part, rim, ui::scaled(2.4F), ui::scaled(1.5F));
  for (const GizmoPart& part : parts) {
    const bool on = part.grip == lit;
    drawPart(ink, part, on ? ui::Colour::hex(0xffffff) : colourOf(part.grip), ui::scaled(on ? 3.4F : 2.4F),
             0);
  }
  if (const auto knob = knobOf(gizmo, ink.view(), scale); knob && !parts.empty()) {
    const ImVec2 at = ink.onWindow(*knob);
    ink.list().AddCircleFilled(at, ui::scaled(6.5F), rim.packed());
    ink.list().AddCircleFilled(at, ui::scaled(5),
                               (lit == GizmoGrip::turn ? ui::Colour::hex(0xffffff) : kRing).packed());
  }
  ink.dot(gizmo.at, lit == GizmoGrip::plane ? kRing : ui::Colour::hex(0xffffff), 4);
}

void drawLandings(const SceneInk& ink, const LayoutSpec& spec, const CellGroup& group,
                  const LatticeStep& step, double floor) {
  constexpr std::size_t kMost = 500;
  std::size_t drawn = 0;
  for (const CellGroup::Landing& landing : group.landings(step, true)) {
    if (++drawn > kMost) return;
    const ConvexPolygon polygon = cellPolygon(spec, landing.to);
    const ui::Colour colour = landing.blocked ? ui::Colour(palette::danger) : ui::Colour(palette::accent);
    ink.fill(polygon.corners, floor, colour.withOpacity(0.2F));
    ink.loop(polygon.corners, floor, colour, 2);
  }
}

void drawScenePaths(const SceneInk& ink, const PathSituation& situation, const OpenProject& open,
                    const PathHit& hit) {
  const WalkSelection& selection = situation.selection;
  for (std::size_t p = 0; p < situation.paths.size(); ++p) {
    const WalkPath& walk = situation.paths[p];
    if (walk.storey != situation.storey) continue;
    const bool selected = selection.kind == WalkSelection::Kind::path && selection.number == p;
    const std::vector<PathPose>& poses = walk.path.poses;
    for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
      if (selected) ink.line(poses[i].eye, poses[i + 1].eye, palette::backdrop.withOpacity(0.7F), 5);
      ink.line(poses[i].eye, poses[i + 1].eye, selected ? kPathColour : kPathColour.withOpacity(0.5F),
               selected ? 2.4F : 1.6F);
    }
    if (!selected) continue;
    for (std::size_t i = 0; i < poses.size(); ++i)
      drawPose(ink, poses[i], i == 0, selection.pose == i, !open.ground->holds(walk.storey, poses[i].eye));
  }
  if (hit.kind == PathHit::Kind::nothing) return;
  const WalkPath& walk = situation.paths[hit.path];
  const double height = poseAt(walk.path, hit.seconds).eye.z;
  const bool selected = selection.kind == WalkSelection::Kind::path && selection.number == hit.path;
  if (hit.kind == PathHit::Kind::line && selected) return ink.plus({hit.place, height}, palette::text);
  if (const auto at = ink.at({hit.place, height}); at && hit.kind != PathHit::Kind::line)
    ink.list().AddCircle(*at, ui::scaled(8.5F), palette::text.packed(), 0, ui::scaled(1.6F));
}

void drawSceneApvs(const SceneInk& ink, const LayoutSpec& spec, const std::set<CellId>& selection,
                   const std::optional<Apv>& inHand, double floor) {
  const auto draw = [&](const Apv& apv, const ui::Colour& colour, bool filled) {
    if (!apv.traditional()) {
      const ConvexPolygon polygon = polygonOf(apv);
      if (filled) ink.fill(polygon.corners, floor, colour.withOpacity(0.12F));
      ink.loop(polygon.corners, floor, colour, 1.8F);
    }
    ink.line({apv.centre, floor}, {apv.centre, spec.floorHeight + spec.eyeHeight}, colour.withOpacity(0.6F),
             1.4F);
    ink.dot({apv.centre, floor}, colour, 4.5F);
  };
  for (const auto& [number, apv] : spec.freeApvs)
    draw(apv,
         selection.contains({number, 0, kFreeSlot}) ? ui::Colour(palette::accent) : ui::Colour(palette::text),
         false);  // placed ones are filled as cells are
  if (inHand) draw(*inHand, palette::accent, true);
}

void drawSceneOutline(const SceneInk& ink, const Outline& outline, const OutlineTool& tool,
                      const OutlineHit& hit, const std::optional<glm::dvec2>& pointer, double floor) {
  const ui::Colour accent = palette::accent;
  for (const auto& loop : outline.loops) {
    ink.loop(loop, floor, palette::backdrop.withOpacity(0.5F), 3.4F);
    ink.loop(loop, floor, accent, 1.8F, true);
    for (const glm::dvec2& corner : loop) ink.square({corner, floor}, accent, 3.5F, false);
  }
  if (hit.kind == OutlineHit::Kind::corner) ink.square({hit.place, floor}, accent, 5, true);
  if (hit.kind == OutlineHit::Kind::side) ink.plus({hit.place, floor}, accent);
  const auto& corners = tool.corners();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    if (k + 1 < corners.size() || pointer)
      ink.line({corners[k], floor}, {k + 1 < corners.size() ? corners[k + 1] : *pointer, floor}, accent, 2);
    ink.dot({corners[k], floor}, accent, k == 0 ? 6.0F : 4.0F);
  }
  const std::vector<glm::dvec2> rectangle = tool.rectangle();
  ink.fill(rectangle, floor, accent.withOpacity(0.12F));
  ink.loop(rectangle, floor, accent, 2);
}

void drawSceneLattice(const SceneInk& ink, const LatticeHandles& handles, LatticeGrip lit, double floor) {
  constexpr int kSteps = 96;
  const ui::Colour accent = palette::accent, text = palette::text;
  const double radius = glm::distance(handles.centre, handles.turn);
  std::vector<glm::dvec2> circle;
  for (int k = 0; k < kSteps; ++k)
    circle.push_back(handles.centre + radius * directionOf(kTwoPi * k / kSteps));
  const glm::dvec3 centre(handles.centre, floor), turn(handles.turn, floor), size(handles.size, floor);
  ink.loop(circle, floor, palette::backdrop.withOpacity(0.6F), 3.5F);
  ink.loop(circle, floor, accent, 1.4F);
  ink.line(centre, turn, accent, 1.4F);
  ink.line(centre, size, accent, 1.4F);
  ink.dot(turn, lit == LatticeGrip::turn ? text : accent, 5.5F);
  ink.square(size, lit == LatticeGrip::size ? text : accent, 5.5F, true);
  ink.dot(centre, lit == LatticeGrip::origin ? text : accent, 6.5F);
}

void drawSceneTrial(const SceneInk& ink, const LayoutSpec& spec, const glm::dvec2& middle, double floor) {
  constexpr int kMost = 600;
  constexpr double kReach = 10;  ///< cells
  const double reach = kReach * spec.cellSize;
  for (const LatticeCell& cell : cellsIn(spec, middle - reach, middle + reach, kMost)) {
    const bool placed = isPlaced(spec, cell.id);
    if (placed) ink.fill(cell.polygon.corners, floor, palette::accent.withOpacity(0.12F));
    ink.loop(cell.polygon.corners, floor, palette::accent.withOpacity(placed ? 0.9F : 0.3F),
             placed ? 1.6F : 1.0F);
  }
}

void drawSceneRuler(const SceneInk& ink, const MeasureTool::Ruler& ruler, double floor) {
  const glm::dvec3 from(ruler.from, floor), to(ruler.to, floor);
  ink.line(from, to, palette::backdrop.withOpacity(0.8F), 4.5F);
  ink.line(from, to, palette::warning, 2);
  for (const auto& [end, corner] : {std::pair(from, ruler.fromCorner), std::pair(to, ruler.toCorner)}) {
    if (corner) ink.square(end, palette::warning, 6, false);
    ink.dot(end, palette::warning, 3.5F);
  }
}

void drawSceneMarquee(const SceneInk& ink, const MarqueeIntent& box, double floor) {
  const std::array<glm::dvec2, 4> corners{box.low, glm::dvec2(box.high.x, box.low.y), box.high,
                                          glm::dvec2(box.low.x, box.high.y)};
  ink.fill(corners, floor, palette::accent.withOpacity(0.12F));
  ink.loop(corners, floor, palette::accent, 1.6F);
}

}  // namespace acentric::editor
