#include "editor/overlays/plan_layers.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "editor/commands/density_edits.h"
#include "editor/overlays/bake_signs.h"
#include "editor/overlays/scale_colour.h"
#include "ui/canvas_draw.h"
#include "ui/theme.h"

namespace acentric::editor {
namespace {

namespace palette = ui::palette;

constexpr double kSectorRoom = 64;                     ///< pixels per cell edge from which sectors are shown
constexpr std::size_t kFewSelected = 64;               ///< drawn one by one
constexpr double kBordersFrom = 3, kBordersWhole = 9;  ///< pixels per cell edge
constexpr double kCamerasFrom = 6, kCamerasWhole = 16;

ui::PolygonStyle bakeStyle(const Region& region, BakeState state) {
  const ui::Colour colour = colourOf(state);
  // Lighter and darker besides the hue: for eyes that miss it.
  const float value = state == BakeState::baked ? 1 : 0.8F;
  return {colour.withOpacity(value * (region.kind == RegionKind::ring ? 0.22F : 0.13F)).packed(),
          colour.withOpacity(0.9F).packed(), 1.5F};
}

ui::PolygonStyle triangleStyle(std::size_t count, std::size_t most, std::size_t budget) {
  const bool over = budget > 0 && count > budget;
  // By the root: most cells hold few, some very many.
  const ui::Colour colour =
      over ? ui::Colour(palette::alarm) : scaleColour(std::sqrt(double(count) / double(most)));
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
  if (sameLayout && before.captures == shown_.captures && before.palette == shown_.palette) return;
  sectorsSent_ = false;
  sendCameraColours();
}

void PlanLayers::sendShapes() {
  const Layout& layout = *shown_.layout;
  std::vector<const ConvexPolygon*> polygons;
  polygons.reserve(layout.regions.size());
  middles_.clear(), densities_.clear();
  for (const Region& region : layout.regions) {
    polygons.push_back(&region.polygon);
    middles_.push_back(region.polygon.centroid());
    densities_.push_back(densityOf(layout.spec, region.id));
  }
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

ui::PolygonStyle PlanLayers::styleOf(std::size_t region, double most) const {
  switch (shown_.overlay) {
    case PlanOverlay::bake:
    case PlanOverlay::checks:
      return bakeStyle(shown_.layout->regions[region], states_[region]);
    case PlanOverlay::triangles:
      if (!shown_.inspection) break;
      return triangleStyle(shown_.inspection->budgets.triangles[region], std::size_t(most), shown_.budget);
    case PlanOverlay::bytes: {
      if (bytes_[region] == 0) break;
      const ui::Colour colour = scaleColour(std::sqrt(double(bytes_[region]) / most));
      return {colour.withOpacity(0.6F).packed(), colour.withOpacity(0.8F).packed(), 1};
    }
    case PlanOverlay::density: {
      const double density = densities_[region];
      if (density == 1) break;
      const double from = std::log(kLeastRegionDensity), to = std::log(kMostRegionDensity);
      const ui::Colour colour = scaleColour((std::log(density) - from) / (to - from));
      return {colour.withOpacity(0.6F).packed(), colour.withOpacity(0.8F).packed(), 1};
    }
    case PlanOverlay::coverage:
    case PlanOverlay::none:
      break;
  }
  return {0, palette::text.withOpacity(0.28F).packed(), 1};
}

void PlanLayers::sendRegionColours() {
  const Layout& layout = *shown_.layout;
  const bool known = shown_.captures && shown_.captures->cameras.size() == layout.cameras.size();
  states_ = !known         ? std::vector<BakeState>(layout.regions.size(), BakeState::missing)
            : shown_.marks ? regionStates(layout, *shown_.captures, *shown_.marks)
                           : shown_.captures->regions;
  bytes_.clear();
  double most = 1;
  if (shown_.overlay == PlanOverlay::bytes) {
    bytes_ = regionBytes(
        layout, known ? shown_.captures->bytes : std::vector<std::uint64_t>(layout.cameras.size(), 0));
    if (!bytes_.empty()) most = std::max(1.0, double(std::ranges::max(bytes_)));
  } else if (shown_.overlay == PlanOverlay::triangles && shown_.inspection) {
    most = double(std::max<std::size_t>(shown_.inspection->budgets.worst(), 1));
  }
  std::vector<ui::PolygonStyle> styles(layout.regions.size());
  for (std::size_t r = 0; r < styles.size(); ++r) styles[r] = styleOf(r, most);
  regions_.setStyles(styles);
}

void PlanLayers::drawSigns(ImDrawList& list, const ui::CanvasView& view) const {
  constexpr double kRoom = 44;  // pixels per cell edge
  if (!shown_.layout || cellPixels(view) < kRoom) return;
  const float radius = float(std::clamp(cellPixels(view) * 0.06, 4.0, 7.0));
  for (std::size_t r = 0; r < middles_.size(); ++r) {
    const glm::dvec2 at = view.screenFromWorld(middles_[r]);
    if (view.contains(at)) drawBakeSign(list, ui::imVec(at), states_[r], radius);
  }
}

void PlanLayers::drawDensities(ImDrawList& list, const ui::CanvasView& view, ImFont* font) const {
  constexpr double kRoom = 30;  // pixels per cell edge
  if (!shown_.layout || cellPixels(view) < kRoom) return;
  for (std::size_t r = 0; r < middles_.size(); ++r) {
    if (densities_[r] == 1) continue;
    const glm::dvec2 at = view.screenFromWorld(middles_[r]);
    if (view.contains(at))
      ui::drawLabel(list, font, ui::imVec(at + glm::dvec2(8, 9)), palette::text,
                    ("× " + densityText(densities_[r])).c_str());
  }
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
  if (selection != selection_ || selectedIn_ != &layout || selectedWith_ != shown_.palette) {
    selectedWith_ = shown_.palette;
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
  dots_.draw(list, view, {ui::scaled(float(std::clamp(cell * 0.05, 1.2, 3.5))), rim, 0, opacity});
}

const std::string& PlanLayers::problem() const {
  for (const std::string* problem : {&regions_.problem(), &sectors_.problem()})
    if (!problem->empty()) return *problem;
  return dots_.problem();
}

}  // namespace acentric::editor
