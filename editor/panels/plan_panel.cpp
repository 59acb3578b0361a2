#include "editor/panels/plan_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "editor/actions/path_walk.h"
#include "editor/commands/layout_edits.h"
#include "editor/commands/selection.h"
#include "editor/overlays/bake_signs.h"
#include "editor/overlays/plan_overlays.h"
#include "editor/overlays/tool_overlays.h"
#include "editor/overlays/walk_overlay.h"
#include "editor/panels/array_panel.h"
#include "editor/panels/plan_toolbar.h"
#include "editor/session/engine_texts.h"
#include "editor/session/scene_view.h"
#include "engine/geometry/conventions.h"
#include "ui/canvas_draw.h"
#include "ui/text_format.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

std::span<const std::uint8_t> bytesOf(const ColourImage& image) {
  return {&image.pixels.front().x, image.pixels.size() * sizeof(Rgba8)};
}

}  // namespace

void PlanPanel::fit(const Session& session) {
  const Bounds& bounds = session.built()->scene->bounds;
  const WalkableBox box = walkableBox(*session.built()->layout)
                              .value_or(WalkableBox{glm::dvec2(bounds.min), glm::dvec2(bounds.max)});
  view_.fit(box.low, box.high, 0.08);
}

void PlanPanel::followEye(const EditorState& state) {
  const glm::dvec2 eye(state.walker.pose().eye), before = std::exchange(eye_, eye);
  if (eye == before || !view_.contains(view_.screenFromWorld(before))) return;
  const glm::dvec2 at = view_.screenFromWorld(eye);
  if (!view_.contains(at)) view_.panPixels(view_.areaMin() + 0.5 * view_.areaSize() - at);
}

void PlanPanel::drawCounts(ImDrawList& list, const Layout& layout, ImFont* font) const {
  const std::string text = trf("{} regions, {} cameras", ui::formatCount(layout.regions.size()),
                               ui::formatCount(layout.cameras.size()));
  const float width = font->CalcTextSizeA(font->FontSize, 1000, 0, text.c_str()).x;
  const ImVec2 corner =
      ui::imVec(view_.areaMin() + glm::dvec2(view_.areaSize().x, double(ui::scaled(ui::kRulerPixels))));
  ui::drawLabel(list, font, {corner.x - width - ui::scaled(16), corner.y + ui::scaled(10)}, ui::palette::text,
                text.c_str());
}

void PlanPanel::drawLayout(PanelContext& context, ImDrawList& list, const std::optional<CellId>& hovered) {
  Session& session = context.session();
  const EditorState& state = context.state();
  const OpenProject& open = *session.built();
  const LayoutSpec& spec = session.project().layout();
  const bool tried = state.trial || state.planTool.latticeTool().dragging();
  const bool lattice = !session.shippedWalk();  // which has none
  if (lattice && (state.showLattice || context.log.on())) freeCells_.update(open.layout, view_);
  if (lattice && state.showLattice && !tried) freeCells_.draw(list, view_);
  if (BakeMarks marks = bakeMarks(session.bakeQueue(), open.keys); marks != *marks_)
    marks_ = std::make_shared<const BakeMarks>(std::move(marks));
  layers_.update({open.layout, session.captures(), marks_, state.overlay,
                  state.overlay == PlanOverlay::triangles ? session.inspection() : nullptr,
                  std::size_t(session.project().budget.trianglesPerRegion)});
  if (!layers_.problem().empty() && !std::exchange(problemTold_, true))
    session.messages().add(MessageLevel::error,
                           trf("The plan cannot be drawn on this OpenGL. {}", layers_.problem()));
  if (tried) {
    LayoutSpec wanted = state.trial.value_or(spec);
    if (!state.trial) placeLattice(wanted, state.planTool.latticeTool().place());
    return trial_.draw(list, view_, wanted);
  }
  layers_.drawRegions(list, view_);
  if (session.rebuilding().running()) drawPending(list, view_, open.layout->spec, spec);
  if (hovered) {
    const bool placed = isPlaced(spec, *hovered);
    if (placed || state.showLattice) drawHovered(list, view_, cellPolygon(spec, *hovered), placed);
  }
  layers_.drawSelection(list, view_, state.selection);
}

void PlanPanel::askForFigures(PanelContext& context, const std::optional<CellId>& hovered) {
  Session& session = context.session();
  EditorState& state = context.state();
  session.askForInspection(state.overlay == PlanOverlay::triangles || state.overlay == PlanOverlay::checks ||
                           state.selectionWish != SelectionWish::none || state.showTable);
  session.askForCoverage(wantedCoverage(state, hovered));
  const PlanMode mode = state.planTool.mode();
  session.askForWalls(mode == PlanMode::lattice || mode == PlanMode::measure);
  snapCorners_.clear();
  if (const auto walls = session.walls()) snapCorners_ = walls->corners;
  if (mode != PlanMode::lattice && mode != PlanMode::measure) return;
  for (const auto& loop : session.project().layout().outline.loops)
    snapCorners_.insert(snapCorners_.end(), loop.begin(), loop.end());
}

void PlanPanel::frame(PanelContext& context) {
  const auto cell = std::exchange(context.state().frameCell, std::nullopt);
  const Layout& layout = *context.session().built()->layout;
  const auto region = cell ? layout.findRegion(*cell) : std::nullopt;
  if (!region) return;
  glm::dvec2 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const glm::dvec2& corner : layout.regions[std::size_t(*region)].grown.corners)
    low = glm::min(low, corner), high = glm::max(high, corner);
  view_.fit(low, high, 0.3);
}

void PlanPanel::drawBackdrop(PanelContext& context, ImDrawList& list) {
  Session& session = context.session();
  if (session.backdrop() != shownBackdrop_) {
    shownBackdrop_ = session.backdrop();
    if (shownBackdrop_)
      backdropTexture_.upload(shownBackdrop_->picture.width, shownBackdrop_->picture.height,
                              bytesOf(shownBackdrop_->picture));
    else
      backdropTexture_.clear();
  }
  if (!context.state().showBackdrop || !shownBackdrop_ || backdropTexture_.empty()) return;
  const ImVec2 upperLeft = ui::imVec(view_.screenFromWorld({shownBackdrop_->min.x, shownBackdrop_->max.y}));
  const ImVec2 lowerRight = ui::imVec(view_.screenFromWorld({shownBackdrop_->max.x, shownBackdrop_->min.y}));
  list.AddImage(backdropTexture_.imguiId(), upperLeft, lowerRight);
  if (ui::currentPalette().light)  // so that dark marks read on it
    list.AddRectFilled(upperLeft, lowerRight, ui::palette::panel.withOpacity(0.5F).packed());
}

void PlanPanel::drawContents(PanelContext& context, ImDrawList& list) {
  Session& session = context.session();
  EditorState& state = context.state();
  const Layout& layout = *session.built()->layout;
  drawBackdrop(context, list);
  ui::drawGrid(list, view_);
  const std::optional<CellId> hovered = hoveredCell(context);
  askForFigures(context, hovered);
  fulfilWish(context);
  coverage_.drawBelow(list, view_, session.coverage());
  drawLayout(context, list, hovered);
  drawWalkable(list, view_, session.project().current().walkable);
  drawOutline(list, view_, session.project().layout().outline);
  drawStairs(list, view_, session.project());
  coverage_.drawAbove(list, view_);
  const bool covered = state.overlay == PlanOverlay::coverage && state.coverageKind == CoverageKind::surfaces;
  const bool tried = state.trial || state.planTool.latticeTool().dragging();
  if (state.showCameras && !covered && !tried) layers_.drawCameras(list, view_);
  if (state.overlay == PlanOverlay::bake && !tried) layers_.drawSigns(list, view_);
  if (!covered && !tried) layers_.drawDensities(list, view_, context.window.fonts().small);
  drawStart(list, view_, session.project().spawn().position, session.project().spawn().yawRadians);
  if (state.showPaths) drawWalks(context, list);
  const WalkPose& pose = state.walker.pose();
  const auto region = layout.regionAt(glm::dvec2(pose.eye));
  drawEye(list, view_, pose, radians(session.project().fovDegrees),
          region ? &layout.regions[std::size_t(*region)] : nullptr);
  drawFreeApvs(list, view_, session.project().layout(), state.selection,
               state.planTool.panoramaTool().inHand());
  tellHovered(context, list, hovered);
  drawLegend(context, list);
  drawTools(context, list);
}

void PlanPanel::drawWalks(PanelContext& context, ImDrawList& list) const {
  const EditorState& state = context.state();
  const Project& project = context.session().project();
  const bool pointing = state.planTool.mode() == PlanMode::path && view_.contains(pointer_) &&
                        !context.inputBlocked && !state.planTool.capturing();
  const glm::dvec2 pointer = view_.worldFromScreen(pointer_);
  drawPaths(list, view_, pathSituation(context.actions), *context.session().built(),
            pointing ? &pointer : nullptr);
  drawBookmarks(list, view_, project, state.walkSelection.bookmark(project), context.window.fonts().small);
}

void PlanPanel::drawLegend(PanelContext& context, ImDrawList& list) {
  Session& session = context.session();
  const EditorState& state = context.state();
  ImFont* font = context.window.fonts().small;
  const auto inspection = session.inspection();
  switch (state.overlay) {
    case PlanOverlay::bake:
      return drawBakeLegend(list, view_, layers_.states(), font);
    case PlanOverlay::triangles:
      if (inspection)
        drawTriangleLegend(list, view_, *inspection, std::size_t(session.project().budget.trianglesPerRegion),
                           font);
      return;
    case PlanOverlay::bytes: {
      std::uint64_t all = 0;
      if (session.captures())
        for (const std::uint64_t bytes : session.captures()->bytes) all += bytes;
      const auto& bytes = layers_.bytes();
      return drawBytesLegend(list, view_, bytes.empty() ? 0 : std::ranges::max(bytes), all, font);
    }
    case PlanOverlay::density:
      return drawDensityLegend(list, view_, session.project().bake.samplesPerDegree, font);
    case PlanOverlay::coverage:
      return coverage_.drawLegend(list, view_, session.coverage().get(), state.coverageKind, font);
    case PlanOverlay::checks:
      if (inspection) drawChecksLegend(list, view_, inspection->placement, font);
      return;
    case PlanOverlay::none:
      break;
  }
}

void PlanPanel::drawOutlineTools(PanelContext& context, ImDrawList& list) {
  const Outline& outline = context.session().project().layout().outline;
  const glm::dvec2 pointer = view_.worldFromScreen(pointer_);
  const OutlineTool& tool = context.state().planTool.outlineTool();
  ImFont* font = context.window.fonts().small;
  if (outline != checkedOutline_) {
    checkedOutline_ = outline;
    faults_ = outlineFaults(outline);
    areas_ = loopAreas(outline);
  }
  drawOutlineHandles(list, view_, outline,
                     tool.corners().empty() && tool.rectangle().empty() ? &pointer : nullptr);
  drawLoopAreas(list, view_, areas_, font);
  drawOutlineFaults(list, view_, faults_, font);
  drawOutlineInHand(list, view_, tool.corners(), pointer);
  drawOutlineRectangle(list, view_, tool.rectangle(), font);
}

void PlanPanel::drawTools(PanelContext& context, ImDrawList& list) {
  Session& session = context.session();
  const EditorState& state = context.state();
  const PlanTool& tool = state.planTool;
  const LayoutSpec& spec = session.project().layout();
  ImFont* font = context.window.fonts().small;
  if (const PlanTool::CellDrag* drag = tool.cellDrag(); drag != nullptr && drag->step != LatticeStep{}) {
    ghost_.show(spec, drag->group, {drag->step}, true);
    ghost_.draw(list, view_);
    if (ghost_.blocked() > 0)
      ui::drawLabel(list, font, ui::imVec(pointer_ + glm::dvec2(16, 14)), ui::palette::danger,
                    trf("{} of {} places taken", ghost_.blocked(), ghost_.places()).c_str());
  } else {
    ghost_.clear();
  }
  array_.draw(list, view_, spec, state.selection, state.array);
  if (const auto box = tool.marquee())
    drawMarquee(list, view_, *box, cellsTouching(*session.built()->layout, box->low, box->high).size(), font);
  if (tool.mode() == PlanMode::density) layers_.drawSelection(list, view_, tool.densityTool().painted());
  if (tool.mode() == PlanMode::outline) drawOutlineTools(context, list);
  if (tool.mode() == PlanMode::lattice) {
    const PlanSituation now = situation(context);
    LayoutSpec shown = spec;
    if (tool.latticeTool().dragging()) placeLattice(shown, tool.latticeTool().place());
    drawLatticeHandles(list, view_, latticeHandles(shown, now.viewLow, now.viewHigh, now.pixelsPerMetre),
                       tool.latticeTool(), pointer_, font);
  }
  if (tool.measureTool().ruler()) drawRuler(list, view_, *tool.measureTool().ruler(), font);
}

void PlanPanel::tellHovered(PanelContext& context, ImDrawList& list,
                            const std::optional<CellId>& hovered) const {
  const EditorState& state = context.state();
  Session& session = context.session();
  const bool pointing = !context.inputBlocked && contains(pointer_) && !state.planTool.capturing();
  const auto inspection = session.inspection();
  if (state.overlay == PlanOverlay::checks && inspection) {
    const PlacementFinding* finding =
        drawFindings(list, view_, inspection->placement, pointing ? pointer_ : glm::dvec2(-1e9));
    if (finding == nullptr) return;
    std::string text = engineText(finding->reason);
    if (finding->push)
      text += trf("\nIt would stand free {:.2f} m away, at ({:.2f}, {:.2f}).", glm::length(*finding->push),
                  finding->place.x + finding->push->x, finding->place.y + finding->push->y);
    if (finding->suffices)
      text += tr("\nIt shows what its cells need all the same: what it misses nobody sees from there.");
    return ui::tooltip(text);
  }
  if (!pointing) return;
  if (state.overlay == PlanOverlay::coverage)
    return ui::tooltip(coverage_.textAt(view_, session.coverage().get(), pointer_));
  const Layout& layout = *session.built()->layout;
  const auto region = hovered ? layout.findRegion(*hovered) : std::nullopt;
  if (!region) return;
  const auto r = std::size_t(*region);
  if (state.overlay == PlanOverlay::triangles && inspection)
    ui::tooltip(trf("{} triangles of local geometry", ui::formatCount(inspection->budgets.triangles[r])));
  if (state.overlay == PlanOverlay::bytes && r < layers_.bytes().size())
    ui::tooltip(trf("{} on disk, in the captures of {} cameras", ui::formatBytes(layers_.bytes()[r]),
                    camerasOf(layout.regions[r]).size()));
  if (state.overlay == PlanOverlay::bake && r < layers_.states().size() && session.captures()) {
    const std::vector<int> cameras = camerasOf(layout.regions[r]);
    const auto& baked = session.captures()->cameras;
    const auto there = std::ranges::count_if(
        cameras, [&](int c) { return std::size_t(c) < baked.size() && baked[std::size_t(c)]; });
    ui::tooltip(trf("{}: {} of {} captures on disk", nameOf(layers_.states()[r]), there, cameras.size()));
  }
}

void PlanPanel::log(PanelContext& context) {
  if (!context.log.on()) return;
  if (const std::size_t selected = context.state().selection.size(); selected != loggedSelection_) {
    context.log.event("selection", std::to_string(selected));
    loggedSelection_ = selected;
  }
  const PlanTool& tool = context.state().planTool;
  const auto point = [&](const char* name, const glm::dvec2& world) {
    const glm::dvec2 at = view_.screenFromWorld(world);
    context.log.rect(name, float(at.x), float(at.y), float(at.x), float(at.y));
  };
  if (tool.mode() == PlanMode::lattice) {
    const PlanSituation now = situation(context);
    const LatticeHandles handles =
        latticeHandles(context.session().project().layout(), now.viewLow, now.viewHigh, now.pixelsPerMetre);
    point("lattice.origin", handles.centre);
    point("lattice.turn", handles.turn);
    point("lattice.size", handles.size);
  }
}

void PlanPanel::logCells(PanelContext& context) const {
  if (!context.log.on()) return;
  const auto logPoint = [&](const glm::dvec2& world, const auto& name) {
    const glm::dvec2 at = view_.screenFromWorld(world);
    if (view_.contains(at)) context.log.rect(name(), float(at.x), float(at.y), float(at.x), float(at.y));
  };
  const auto logCell = [&](const char* kind, const CellId& id, const ConvexPolygon& polygon) {
    logPoint(polygon.centroid(), [&] { return fmt::format("{}.{}.{}.{}", kind, id.i, id.j, id.slot); });
  };
  logPoint(glm::dvec2(context.actions.state.walker.pose().eye), [] { return std::string("plan.eye"); });
  if (const WalkPath* path = context.actions.state.walkSelection.path(context.actions.session.project()))
    for (std::size_t i = 0; i < path->path.poses.size(); ++i)
      logPoint(glm::dvec2(path->path.poses[i].eye), [i] { return fmt::format("pose.{}", i); });
  const Layout& layout = *context.actions.session.built()->layout;
  if (layout.spec.cellSize * view_.pixelsPerMetre() < kLeastCellPixels) return;
  if (!context.actions.session.shippedWalk())
    for (const LatticeCell& cell : freeCells_.cells()) logCell("free", cell.id, cell.polygon);
  for (const Region& region : layout.regions) logCell("cell", region.id, region.polygon);
}

void PlanPanel::drawCanvas(PanelContext& context, const ImVec2& at, const ImVec2& size) {
  view_.setArea(ui::fromIm(at), ui::fromIm(size));
  ImGui::InvisibleButton("##plan", size);
  context.log.item("plan");
  pointer_ = context.window.input().pointer();

  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRect(at, {at.x + size.x, at.y + size.y}, true);
  list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, ui::palette::backdrop.packed());
  if (context.session().built()) {
    if (context.state().fitPlan) {
      fit(context.session());
      context.state().fitPlan = false;
    }
    followEye(context.state());
    frame(context);
    if (const auto frame = std::exchange(context.state().framePlan, std::nullopt))
      view_.fit(frame->low, frame->high);
    handleEvents(context);
    drawContents(context, list);
    logCells(context);
    log(context);
  } else {
    ui::drawGrid(list, view_);
  }
  ImFont* small = context.window.fonts().small;
  const bool inside = view_.contains(pointer_) && !context.inputBlocked;
  ui::drawRulers(list, view_, small, inside ? std::optional(pointer_) : std::nullopt);
  ui::drawScaleBar(list, view_, small);
  if (context.session().built()) drawCounts(list, *context.session().built()->layout, small);
  if (inside) ui::drawCoordinates(list, view_, small, view_.worldFromScreen(pointer_));
  list.PopClipRect();
}

void PlanPanel::draw(PanelContext& context) {
  ImGui::SetCursorPos(ui::scaled(ImVec2(8, 7)));
  ImGui::BeginGroup();
  drawPlanToolbar(context);
  ImGui::EndGroup();
  const float top = ImGui::GetItemRectSize().y + ui::scaled(14);
  ImGui::SetCursorPos({0, top});
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 size = ImGui::GetContentRegionAvail();
  if (size.x < 40 || size.y < 40) return;
  const bool table = context.state().showTable && context.session().built();
  const float tableHeight = table ? std::floor(size.y * 0.45F) : 0;
  drawCanvas(context, at, {size.x, size.y - tableHeight});
  if (table) table_.draw(context, {0, top + size.y - tableHeight}, {size.x, tableHeight});
  arrayLow_ = arrayHigh_ = {0, 0};
  if (!context.state().array || !context.session().built()) return;
  const ImVec2 corner(at.x + ui::scaled(ui::kRulerPixels + 10), at.y + ui::scaled(ui::kRulerPixels + 10));
  arrayLow_ = ui::fromIm(corner);
  arrayHigh_ = ui::fromIm(drawArrayPanel(context, corner, array_.ghost().places(), array_.ghost().blocked()));
}

}  // namespace acentric::editor
