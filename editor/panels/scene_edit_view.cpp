/// What the 3D view shows of the tools and the gizmo, over its picture.
#include <fmt/format.h>

#include "editor/actions/path_walk.h"
#include "editor/commands/layout_edits.h"
#include "editor/overlays/scene_tool_overlays.h"
#include "editor/panels/scene_panel.h"
#include "editor/tools/scene_hits.h"
#include "ui/canvas_draw.h"
#include "ui/theme.h"

namespace acentric::editor {

SceneSight ScenePanel::sight() const {
  return {camera_.view(), camera_.target(), double(ui::interfaceScale())};
}

/// The handle under the pointer or in hand.
GizmoGrip ScenePanel::litGrip(const PanelContext& context, const Gizmo& gizmo) const {
  if (editing_.gizmoTool().capturing()) return editing_.gizmoTool().grip();
  if (!pointing(context)) return GizmoGrip::none;
  return gripAt(gizmo, camera_.view(), pointer_ - area_.min, double(ui::interfaceScale()));
}

void ScenePanel::drawTool(PanelContext& context, const SceneInk& ink,
                          const std::optional<glm::dvec3>& under) {
  const EditorState& state = context.state();
  const Session& session = context.session();
  const LayoutSpec& spec = session.project().layout();
  const PlanTool& tool = state.planTool;
  const double floor = latticeHeight(spec);
  const PlanSituation now = editing_.situation(context.actions, under.value_or(camera_.target()), sight());
  const auto place = under ? std::optional(glm::dvec2(*under)) : std::nullopt;
  switch (tool.mode()) {
    case PlanMode::cells: {
      if (const auto box = tool.marquee()) drawSceneMarquee(ink, *box, floor);
      if (const auto* drag = tool.cellDrag()) drawLandings(ink, spec, drag->group, drag->step, floor);
      if (!place || !state.scene3d.placing || tool.capturing()) return;
      const LatticeCell cell = cellAt(spec, *place);
      if (isPlaced(spec, cell.id)) return;
      ink.loop(cell.polygon.corners, floor, ui::palette::accent, 1.6F, true);
      return ink.plus({cell.polygon.centroid(), floor}, ui::palette::accent);
    }
    case PlanMode::outline: {
      const bool drawing = !tool.outlineTool().corners().empty() || !tool.outlineTool().rectangle().empty();
      const OutlineHit hit =
          place && !drawing ? hitOutline(spec.outline, *place, now.pixelsPerMetre) : OutlineHit{};
      return drawSceneOutline(ink, spec.outline, tool.outlineTool(), hit, place, floor);
    }
    case PlanMode::lattice: {
      LayoutSpec shown = spec;
      if (tool.latticeTool().dragging()) {
        placeLattice(shown, tool.latticeTool().place());
        drawSceneTrial(ink, shown, glm::dvec2(camera_.target()), floor);
      }
      const LatticeHandles handles = latticeHandles(shown, now.viewLow, now.viewHigh, now.pixelsPerMetre);
      const LatticeGrip lit = tool.latticeTool().dragging() ? tool.latticeTool().grip()
                              : place                       ? handles.gripAt(*place, now.pixelsPerMetre)
                                                            : LatticeGrip::none;
      return drawSceneLattice(ink, handles, lit, floor);
    }
    case PlanMode::measure:
      if (tool.measureTool().ruler()) drawSceneRuler(ink, *tool.measureTool().ruler(), floor);
      return;
    case PlanMode::density:
      for (const CellId& cell : tool.densityTool().painted())
        ink.loop(cellPolygon(spec, cell).corners, floor, ui::palette::accent, 1.6F);
      return;
    case PlanMode::eye:
    case PlanMode::panorama:
    case PlanMode::path:
      return;
  }
}

void ScenePanel::drawEditing(PanelContext& context, ImDrawList& list, const PerspectiveView& view) {
  EditorState& state = context.state();
  const Session& session = context.session();
  const LayoutSpec& spec = session.project().layout();
  const SceneInk ink(list, view, area_.min);
  const double floor = latticeHeight(spec);
  const bool follows = editing_.capturing(context.actions);
  std::optional<glm::dvec3> under;
  if (pointing(context) || follows)
    under = editing_.placeUnder(context.actions, pointer_ - area_.min, sight());
  const auto& laid = session.built()->layout->spec.outline;
  if (state.planTool.mode() != PlanMode::outline && spec.outline != laid)
    for (const auto& loop : spec.outline.loops) ink.loop(loop, floor, ui::palette::accent, 2);
  if (state.showPaths) {
    const PathSituation paths = pathSituation(context.actions);
    const bool points = under && state.planTool.mode() == PlanMode::path && !follows;
    drawScenePaths(ink, paths, *session.built(),
                   points ? hitPaths(paths, glm::dvec2(*under),
                                     editing_.situation(context.actions, *under, sight()).pixelsPerMetre)
                          : PathHit{});
  }
  drawSceneApvs(ink, spec, state.selection, state.planTool.panoramaTool().inHand(), floor);
  drawTool(context, ink, under);
  if (const auto* cells = editing_.cellsOnTheirWay(); cells != nullptr && cells->step != LatticeStep{})
    drawLandings(ink, spec, cells->group, cells->step, floor);
  const auto gizmo = editing_.gizmo(context.actions);
  if (gizmo) {
    context.session().askForWalls(true);
    drawGizmo(ink, *gizmo, litGrip(context, *gizmo));
  }
  if (const auto corner = placeOf(spec.outline, state.scene3d.corner); corner && gizmo)
    ink.square({*corner, floor}, ui::palette::accent, 4.5F, true);
  state.scene3d.readout = follows ? editing_.text(context.actions) : std::string();
  if (!state.scene3d.readout.empty())
    ui::drawLabel(list, context.window.fonts().small, ui::imVec(pointer_ + glm::dvec2(18, 16)),
                  ui::palette::text, state.scene3d.readout.c_str());
  if (context.log.on()) logHandles(context, ink, gizmo);
}

void ScenePanel::logHandles(PanelContext& context, const SceneInk& ink,
                            const std::optional<Gizmo>& gizmo) const {
  const LayoutSpec& spec = context.actions.session.project().layout();
  const double floor = latticeHeight(spec);
  const auto log = [&](const ImVec2& at, const std::string& name) {
    if (area_.holds(ui::fromIm(at))) context.log.rect(name, at.x, at.y, at.x, at.y);
  };
  const auto logPlace = [&](const glm::dvec3& place, const std::string& name) {
    if (const auto at = ink.at(place)) log(*at, name);
  };
  if (gizmo) {
    static constexpr const char* kNames[] = {"none", "x", "y", "plane", "up", "turn"};
    for (const GizmoPart& part : partsOf(*gizmo, ink.view(), double(ui::interfaceScale()))) {
      const std::size_t middle = part.pixels.size() / 2;
      const glm::dvec2 at = part.grip == GizmoGrip::turn
                                ? part.pixels[middle]
                                : glm::mix(part.pixels.front(), part.pixels[middle], 0.6);
      log(ink.onWindow(at), fmt::format("gizmo.{}", kNames[std::size_t(part.grip)]));
    }
  }
  for (const auto& [number, apv] : spec.freeApvs)
    logPlace({apv.centre, floor}, fmt::format("apv3d.{}", number));
  constexpr std::size_t kMostLogged = 40;
  const auto& loops = spec.outline.loops;
  for (std::size_t l = 0; l < loops.size(); ++l)
    for (std::size_t k = 0; k < std::min(kMostLogged, loops[l].size()); ++k)
      logPlace({loops[l][k], floor}, fmt::format("corner3d.{}.{}", l, k));
  if (const WalkPath* walk = context.actions.state.walkSelection.path(context.actions.session.project()))
    for (std::size_t i = 0; i < std::min(kMostLogged, walk->path.poses.size()); ++i)
      logPlace(walk->path.poses[i].eye, fmt::format("pose3d.{}", i));
  if (!context.actions.state.scene3d.placing) return;
  const glm::dvec2 middle(camera_.target());
  const double reach = 3 * spec.cellSize;
  for (const LatticeCell& cell : cellsIn(spec, middle - reach, middle + reach, int(kMostLogged)))
    if (!isPlaced(spec, cell.id))
      logPlace({cell.polygon.centroid(), floor},
               fmt::format("free3d.{}.{}.{}", cell.id.i, cell.id.j, cell.id.slot));
}

}  // namespace acentric::editor
