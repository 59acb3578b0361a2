#include "editor/overlays/plan_layers.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "editor/overlays/plan_overlays.h"
#include "editor/overlays/scale_colour.h"
#include "ui/canvas_draw.h"

namespace acentric::editor {
namespace {

namespace palette = ui::palette;

constexpr double kSectorRoom = 64;                     ///< pixels per cell edge from which sectors are shown
constexpr std::size_t kFewSelected = 64;               ///< drawn one by one
constexpr double kBordersFrom = 3, kBordersWhole = 9;  ///< pixels per cell edge
constexpr double kCamerasFrom = 6, kCamerasWhole = 16;

ui::PolygonStyle bakeStyle(const Region& region, BakeState state) {
  const ui::Colour colour = colourOf(state);
  return {colour.withOpacity(region.kind == RegionKind::ring ? 0.20F : 0.11F).packed(),
          colour.withOpacity(0.75F).packed(), 1.2F};
}

ui::PolygonStyle triangleStyle(std::size_t count, std::size_t most, std::size_t budget) {
  const bool over = budget > 0 && count > budget;
  // By the root: most cells hold few, some very many.
  const ui::Colour colour = over ? palette::danger : scaleColour(std::sqrt(double(count) / double(most)));
  return {colour.withOpacity(0.6F).packed(), colour.withOpacity(over ? 1.0F : 0.8F).packed(),
          over ? 2.2F : 1.0F};
}

bool baked(const PlanContents& contents, std::size_t camera) {
  return contents.captures && camera < contents.captures->cameras.size() &&
         contents.captures->cameras[camera];
}

}  // namespace

float fadeIn(double pixels, double low, double high) {
  return float(std::clamp((pixels - low) / (high - low), 0.0, 1.0));
}

void setPolygons(ui::PolygonMesh& mesh, const std::vector<const ConvexPolygon*>& polygons) {
  std::vector<glm::dvec2> corners;
  std::vector<std::uint32_t> ends;
  ends.reserve(polygons.size());
  for (const ConvexPolygon* polygon : polygons) {
    corners.insert(corners.end(), polygon->corners.begin(), polygon->corners.end());
    ends.push_back(std::uint32_t(corners.size()));
  }
  mesh.setShapes(corners, ends);
}

void PlanLayers::update(const PlanContents& contents) {
  if (contents == shown_) return;
  const PlanContents before = std::exchange(shown_, contents);
  const bool sameLayout = before.layout == shown_.layout;
  if (!sameLayout) sendShapes();
  sendRegionColours();
  if (sameLayout && before.captures == shown_.captures) return;
  sectorsSent_ = false;
  sendCameraColours();
}

void PlanLayers::sendShapes() {
  const Layout& layout = *shown_.layout;
  std::vector<const ConvexPolygon*> polygons;
  polygons.reserve(layout.regions.size());
  for (const Region& region : layout.regions) polygons.push_back(&region.polygon);
  setPolygons(regions_, polygons);
  // Cameras at one centre of projection follow one another.
  std::vector<ui::CanvasMark> dots;
  dotEnds_.clear();
  for (std::size_t c = 0; c < layout.cameras.size(); ++c) {
    if (dots.empty() || dots.back().place != layout.cameras[c].position) {
      dots.push_back({layout.cameras[c].position, 0, 0});
      dotEnds_.push_back(c);
    }
    dotEnds_.back() = c + 1;
  }
  dots_.setPlaces(dots);
}

void PlanLayers::sendSectors() {
  std::vector<ui::CanvasMark> sectors;
  std::vector<ImU32> colours;
  const std::vector<LayoutCamera>& cameras = shown_.layout->cameras;
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    sectors.push_back({cameras[c].position, float(cameras[c].lowAzimuth), float(cameras[c].fovRadians)});
    colours.push_back(colourOf(baked(shown_, c) ? BakeState::baked : BakeState::missing).packed());
  }
  sectors_.setPlaces(sectors);
  sectors_.setColours(colours);
  sectorsSent_ = true;
}

void PlanLayers::sendRegionColours() {
  const std::vector<Region>& regions = shown_.layout->regions;
  std::vector<ui::PolygonStyle> styles(regions.size());
  const Inspection* triangles =
      shown_.triangles && shown_.triangles->layout == shown_.layout ? shown_.triangles.get() : nullptr;
  const std::size_t most = triangles ? std::max<std::size_t>(triangles->budgets.worst(), 1) : 1;
  const CaptureStatus* captures = shown_.captures.get();
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const bool known = captures != nullptr && r < captures->regions.size();
    styles[r] = triangles ? triangleStyle(triangles->budgets.triangles[r], most, shown_.budget)
                          : bakeStyle(regions[r], known ? captures->regions[r] : BakeState::missing);
    if (shown_.faint) styles[r] = {0, palette::text.withOpacity(0.28F).packed(), 1};
  }
  regions_.setStyles(styles);
}

void PlanLayers::sendCameraColours() {
  std::vector<ImU32> colours;
  colours.reserve(dotEnds_.size());
  std::size_t first = 0;
  for (const std::size_t end : dotEnds_) {
    std::size_t there = 0;
    for (std::size_t c = first; c < end; ++c) there += baked(shown_, c) ? 1 : 0;
    const BakeState state = there == 0            ? BakeState::missing
                            : there < end - first ? BakeState::partial
                                                  : BakeState::baked;
    colours.push_back(colourOf(state).packed());
    first = end;
  }
  dots_.setColours(colours);
}

double PlanLayers::cellPixels(const ui::CanvasView& view) const {
  return shown_.layout->spec.cellSize * view.pixelsPerMetre();
}

void PlanLayers::drawRegions(ImDrawList& list, const ui::CanvasView& view) {
  if (shown_.layout) regions_.draw(list, view, fadeIn(cellPixels(view), kBordersFrom, kBordersWhole));
}

void PlanLayers::drawSelection(ImDrawList& list, const ui::CanvasView& view,
                               const std::set<CellId>& selection) {
  if (!shown_.layout || selection.empty()) return;
  const Layout& layout = *shown_.layout;
  const ui::Colour fill = palette::accent.withOpacity(0.25F);
  constexpr float kWidth = 2.2F;
  if (selection.size() <= kFewSelected) {
    for (const CellId& cell : selection)
      if (const auto region = layout.findRegion(cell))
        ui::drawConvex(list, view, layout.regions[std::size_t(*region)].polygon.corners, fill,
                       palette::accent, kWidth);
    return;
  }
  if (selection != selection_ || selectedIn_ != &layout) {
    std::vector<const ConvexPolygon*> polygons;
    for (const CellId& cell : selection)
      if (const auto region = layout.findRegion(cell))
        polygons.push_back(&layout.regions[std::size_t(*region)].polygon);
    setPolygons(selected_, polygons);
    selected_.setStyles(
        std::vector<ui::PolygonStyle>(polygons.size(), {fill.packed(), palette::accent.packed(), kWidth}));
    selection_ = selection;
    selectedIn_ = &layout;
  }
  selected_.draw(list, view, fadeIn(cellPixels(view), kBordersFrom, kBordersWhole));
}

void PlanLayers::drawCameras(ImDrawList& list, const ui::CanvasView& view) {
  if (!shown_.layout) return;
  const double cell = cellPixels(view);
  const ImVec4 rim = palette::backdrop.withOpacity(0.8F).vec();
  const float opacity = fadeIn(cell, kCamerasFrom, kCamerasWhole);
  if (cell >= kSectorRoom) {
    if (!sectorsSent_) sendSectors();
    sectors_.draw(list, view, {0, rim, float(std::min(26.0, cell * 0.18)), opacity});
  }
  dots_.draw(list, view, {float(std::clamp(cell * 0.05, 1.2, 3.5)), rim, 0, opacity});
}

const std::string& PlanLayers::problem() const {
  for (const std::string* problem : {&regions_.problem(), &sectors_.problem()})
    if (!problem->empty()) return *problem;
  return dots_.problem();
}

}  // namespace acentric::editor
