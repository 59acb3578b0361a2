#include "editor/panels/plan_panel.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "editor/commands/layout_edits.h"
#include "editor/overlays/plan_overlays.h"
#include "engine/geometry/conventions.h"
#include "engine/pipeline/camera_path.h"
#include "ui/canvas_draw.h"
#include "ui/keys.h"
#include "ui/text_format.h"

namespace acentric::editor {
namespace {

std::span<const std::uint8_t> bytesOf(const ColourImage& image) {
  return {&image.pixels.front().x, image.pixels.size() * sizeof(Rgba8)};
}

PlanSituation situationOf(PanelContext& context, const ui::CanvasView& view) {
  return {&context.session().project().layout(), &context.state().selection,
          glm::dvec2(context.state().walker.pose().eye), view.pixelsPerMetre()};
}

}  // namespace

void PlanPanel::fit(const Session& session) {
  const Bounds& bounds = session.built()->scene->bounds;
  const Layout& layout = *session.built()->layout;
  glm::dvec2 low(std::numeric_limits<double>::max());
  glm::dvec2 high(std::numeric_limits<double>::lowest());
  for (const Region& region : layout.regions)
    for (const glm::dvec2& corner : region.polygon.corners)
      low = glm::min(low, corner), high = glm::max(high, corner);
  if (layout.regions.empty()) low = glm::dvec2(bounds.min), high = glm::dvec2(bounds.max);
  view_.fit(low, high, 0.08);
}

void PlanPanel::drawToolbar(PanelContext& context) {
  constexpr float kNear = 3, kApart = 16;
  struct Entry {
    const char* id;
    const char* label;
    float gap;
    ButtonLook look = ButtonLook::toggle;
  };
  static constexpr std::array<Entry, 11> kEntries{{{"tool.cells", "Cells", 0},
                                                   {"tool.eye", "Eye", kNear},
                                                   {"tool.outline", "Outline", kNear},
                                                   {"tool.panorama", "APV", kNear},
                                                   {"view.backdrop", "Scene", kApart},
                                                   {"view.lattice", "Lattice", kNear},
                                                   {"view.cameras", "Cameras", kNear},
                                                   {"view.triangles", "Triangles", kNear},
                                                   {"view.checks", "Checks", kNear},
                                                   {"view.coverage", "Coverage", kNear},
                                                   {"view.fit", "Fit", kApart, ButtonLook::plain}}};
  const float right = ImGui::GetWindowSize().x - 8;
  for (const Entry& entry : kEntries) {
    const float width = ImGui::CalcTextSize(entry.label).x + 2 * ImGui::GetStyle().FramePadding.x;
    if (entry.gap > 0) ImGui::SameLine(0, entry.gap);
    if (ImGui::GetCursorPosX() + width > right) ImGui::NewLine();
    actionButton(context, entry.id, entry.look, {}, entry.label);
  }
  if (!context.state().showCoverage) return;
  ImGui::AlignTextToFramePadding();
  ui::mutedText("Coverage of");
  for (const auto& [id, label] :
       {std::pair("coverage.surfaces", "surfaces"), std::pair("coverage.layout", "the plan"),
        std::pair("coverage.cell", "a cell")}) {
    ImGui::SameLine(0, id == std::string_view("coverage.surfaces") ? 10.0F : 3.0F);
    actionButton(context, id, ButtonLook::toggle, {}, label);
  }
}

void PlanPanel::drawCounts(ImDrawList& list, const Layout& layout, ImFont* font) const {
  const std::string text = fmt::format("{} regions, {} cameras", ui::formatCount(layout.regions.size()),
                                       ui::formatCount(layout.cameras.size()));
  const float width = font->CalcTextSizeA(font->FontSize, 1000, 0, text.c_str()).x;
  const ImVec2 corner = ui::imVec(view_.areaMin() + glm::dvec2(view_.areaSize().x, ui::kRulerPixels));
  ui::drawLabel(list, font, {corner.x - width - 16, corner.y + 10}, ui::palette::text, text.c_str());
}

void PlanPanel::drawLayout(PanelContext& context, ImDrawList& list, const std::optional<CellId>& hovered) {
  Session& session = context.session();
  const EditorState& state = context.state();
  const OpenProject& open = *session.built();
  const LayoutSpec& spec = session.project().layout();
  if (state.showLattice || context.log.on()) freeCells_.update(open.layout, view_);
  if (state.showLattice) freeCells_.draw(list, view_);
  layers_.update({open.layout, session.captures(), state.showTriangles ? session.inspection() : nullptr,
                  std::size_t(session.project().budget.trianglesPerRegion), state.showCoverage});
  layers_.drawRegions(list, view_);
  if (!layers_.problem().empty() && !std::exchange(problemTold_, true))
    session.messages().add(MessageLevel::error,
                           "The plan cannot be drawn on this OpenGL. " + layers_.problem());
  if (session.rebuilding().running()) drawPending(list, view_, open.layout->spec, spec);
  if (hovered) {
    const bool placed = isPlaced(spec, *hovered);
    if (placed || state.showLattice) drawHovered(list, view_, cellPolygon(spec, *hovered), placed);
  }
  layers_.drawSelection(list, view_, state.selection);
}

std::optional<CellId> PlanPanel::hoveredCell(const PanelContext& context) const {
  const EditorState& state = context.actions.state;
  const LayoutSpec& spec = context.actions.session.project().layout();
  const bool pointing = state.planTool.mode() == PlanMode::cells && !context.inputBlocked &&
                        view_.contains(pointer_) && !state.planTool.capturing() &&
                        spec.cellSize * view_.pixelsPerMetre() >= kLeastCellPixels;
  if (!pointing) return std::nullopt;
  return cellAt(spec, view_.worldFromScreen(pointer_)).id;
}

void PlanPanel::act(PanelContext& context, const PlanIntent& intent) {
  Session& session = context.session();
  EditorState& state = context.state();
  const Project& project = session.project();
  const auto placeEye = [&](const glm::dvec2& position) {
    WalkPose pose = state.walker.pose();
    pose.eye = glm::dvec3(clampToPlan(*session.built()->layout, position), pose.eye.z);
    state.walker.setPose(pose);
  };
  if (const auto* add = std::get_if<AddCellIntent>(&intent)) {
    if (session.apply(addCell(project, add->cell))) state.selection = {add->cell};
  } else if (const auto* remove = std::get_if<RemoveCellIntent>(&intent)) {
    session.apply(removeCells(project, {remove->cell}));
    state.selection.erase(remove->cell);
  } else if (const auto* select = std::get_if<SelectIntent>(&intent)) {
    state.selection = select->cells;
  } else if (const auto* move = std::get_if<MoveCellIntent>(&intent)) {
    if (session.apply(moveCell(project, move->from, move->to))) state.selection = {move->to};
  } else if (const auto* pan = std::get_if<PanIntent>(&intent)) {
    view_.panPixels(pan->pixels);
  } else if (const auto* place = std::get_if<PlaceEyeIntent>(&intent)) {
    placeEye(place->position);
  } else if (const auto* turn = std::get_if<TurnEyeIntent>(&intent)) {
    WalkPose pose = state.walker.pose();
    pose.yawRadians = turn->yawRadians;
    state.walker.setPose(pose);
  } else if (const auto* outline = std::get_if<OutlineIntent>(&intent)) {
    session.applyLive(setOutline(project, outline->outline), outline->finished);
  } else if (const auto* apv = std::get_if<FreeApvIntent>(&intent)) {
    const int number = apv->number.value_or(nextFreeNumber(project.layout()));
    Edit edit = apv->number ? setFreeApv(project, number, apv->apv) : addFreeApv(project, apv->apv);
    if (!apv->finished)
      session.applyLive(std::move(edit), false);
    else if (session.apply(std::move(edit)))
      state.selection = {{number, 0, kFreeSlot}};
  }
}

void PlanPanel::handleEvents(PanelContext& context) {
  using Kind = ui::InputEvent::Kind;
  PlanTool& tool = context.state().planTool;
  for (const ui::InputEvent& event : context.events) {
    const bool inside = view_.contains(event.position) && !context.inputBlocked;
    if (event.kind == Kind::scroll && inside) view_.zoomAt(event.position, std::pow(1.18, event.scroll.y));
    if (event.kind == Kind::keyPress && !context.inputBlocked && tool.mode() == PlanMode::outline &&
        (event.code == ui::key::enter || event.code == ui::key::keypadEnter))
      act(context, tool.closeOutline());
    if (event.kind == Kind::keyPress && event.code == ui::key::escape && !context.inputBlocked) {
      if (tool.cancel())
        context.session().cancelLive();
      else
        context.state().selection.clear();
    }
    PointerEvent pointer{PointerEvent::Kind::move, event.code, event.modifiers, event.position,
                         view_.worldFromScreen(event.position)};
    if (event.kind == Kind::buttonPress && inside)
      pointer.kind = PointerEvent::Kind::press;
    else if (event.kind == Kind::buttonRelease && tool.capturing())
      pointer.kind = PointerEvent::Kind::release;
    else if (event.kind != Kind::move || !tool.capturing())
      continue;
    act(context, tool.handle(pointer, situationOf(context, view_)));
  }
}

void PlanPanel::drawContents(PanelContext& context, ImDrawList& list) {
  Session& session = context.session();
  EditorState& state = context.state();
  const Layout& layout = *session.built()->layout;
  const LayoutSpec& spec = session.project().layout();
  if (session.backdrop() != shownBackdrop_) {
    shownBackdrop_ = session.backdrop();
    if (shownBackdrop_)
      backdropTexture_.upload(shownBackdrop_->picture.width, shownBackdrop_->picture.height,
                              bytesOf(shownBackdrop_->picture));
    else
      backdropTexture_.clear();
  }
  if (state.showBackdrop && shownBackdrop_ && !backdropTexture_.empty()) {
    const glm::dvec2 upperLeft = view_.screenFromWorld({shownBackdrop_->min.x, shownBackdrop_->max.y});
    const glm::dvec2 lowerRight = view_.screenFromWorld({shownBackdrop_->max.x, shownBackdrop_->min.y});
    list.AddImage(backdropTexture_.imguiId(), ui::imVec(upperLeft), ui::imVec(lowerRight));
  }
  ui::drawGrid(list, view_);
  const std::optional<CellId> hovered = hoveredCell(context);
  session.askForInspection(state.showTriangles || state.showChecks);
  const std::shared_ptr<const Inspection> inspection = session.inspection();
  session.askForCoverage(wantedCoverage(state, hovered));
  const CoveragePicturePtr coverage = session.coverage();
  coverage_.drawBelow(list, view_, coverage);
  drawLayout(context, list, hovered);
  drawOutline(list, view_, spec.outline);
  coverage_.drawAbove(list, view_);
  if (state.showCameras && !(state.showCoverage && state.coverageKind == CoverageKind::surfaces))
    layers_.drawCameras(list, view_);
  drawStart(list, view_, session.project().spawn().position, session.project().spawn().yawRadians);
  const WalkPose& pose = state.walker.pose();
  const auto region = layout.regionAt(glm::dvec2(pose.eye));
  drawEye(list, view_, pose, radians(session.project().fovDegrees),
          region ? &layout.regions[std::size_t(*region)] : nullptr);
  if (const auto drag = state.planTool.cellDrag())
    drawCellDrag(list, view_, spec, *drag, drag->from != drag->to && !isPlaced(spec, drag->to));
  if (state.showCoverage) {
    coverage_.drawLegend(list, view_, coverage.get(), state.coverageKind, context.window.fonts().small);
    if (const std::string text = coverage_.textAt(view_, coverage.get(), pointer_);
        !text.empty() && view_.contains(pointer_) && !context.inputBlocked && !state.planTool.capturing())
      ui::tooltip(text);
  }
  if (inspection) tellInspection(context, list, *inspection, hovered);
  const glm::dvec2 pointer = view_.worldFromScreen(pointer_);
  if (state.planTool.mode() == PlanMode::outline) {
    const OutlineTool& tool = state.planTool.outlineTool();
    drawOutlineHandles(list, view_, spec.outline, tool.corners().empty() ? &pointer : nullptr);
    drawOutlineInHand(list, view_, tool.corners(), pointer);
  }
  drawFreeApvs(list, view_, spec, state.selection, state.planTool.panoramaTool().inHand());
}

void PlanPanel::tellInspection(PanelContext& context, ImDrawList& list, const Inspection& inspection,
                               const std::optional<CellId>& hovered) const {
  const EditorState& state = context.state();
  const glm::dvec2 pointer = context.inputBlocked ? glm::dvec2(-1e9) : pointer_;
  const PlacementFinding* finding =
      state.showChecks ? drawFindings(list, view_, inspection.placement, pointer) : nullptr;
  if (state.showTriangles)
    drawTriangleLegend(list, view_, inspection,
                       std::size_t(context.session().project().budget.trianglesPerRegion),
                       context.window.fonts().small);
  if (finding != nullptr) {
    std::string text = finding->reason;
    if (finding->push)
      text += fmt::format("\nIt would stand free {:.2f} m away, at ({:.2f}, {:.2f}).",
                          glm::length(*finding->push), finding->place.x + finding->push->x,
                          finding->place.y + finding->push->y);
    return ui::tooltip(text);
  }
  if (!state.showTriangles || !hovered) return;
  if (const auto region = inspection.layout->findRegion(*hovered))
    ui::tooltip(fmt::format("{} triangles of local geometry",
                            ui::formatCount(inspection.budgets.triangles[std::size_t(*region)])));
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
  const Layout& layout = *context.actions.session.built()->layout;
  if (layout.spec.cellSize * view_.pixelsPerMetre() < kLeastCellPixels) return;
  for (const LatticeCell& cell : freeCells_.cells()) logCell("free", cell.id, cell.polygon);
  for (const Region& region : layout.regions) logCell("cell", region.id, region.polygon);
}

void PlanPanel::draw(PanelContext& context) {
  ImGui::SetCursorPos({8, 7});
  ImGui::BeginGroup();
  drawToolbar(context);
  ImGui::EndGroup();
  const float top = ImGui::GetItemRectSize().y + 14;
  ImGui::SetCursorPos({0, top});
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 size = ImGui::GetContentRegionAvail();
  if (size.x < 40 || size.y < 40) return;
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
    handleEvents(context);
    drawContents(context, list);
    logCells(context);
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

}  // namespace acentric::editor
