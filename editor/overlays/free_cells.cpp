#include "editor/overlays/free_cells.h"

#include <algorithm>

#include "editor/overlays/plan_layers.h"
#include "ui/colour.h"

namespace acentric::editor {
namespace {

constexpr int kMostCells = 40'000;       ///< that are looked at
constexpr double kWholeFromPixels = 18;  ///< per cell edge
constexpr double kLeastCellArea = 0.4;   ///< of a cell of edge 1: the triangle

bool within(const ui::CanvasBox& inner, const ui::CanvasBox& outer) {
  return inner.low.x >= outer.low.x && inner.low.y >= outer.low.y && inner.high.x <= outer.high.x &&
         inner.high.y <= outer.high.y;
}

}  // namespace

void FreeCells::update(const std::shared_ptr<const Layout>& layout, const ui::CanvasView& view) {
  const double cellSize = layout->spec.cellSize;
  const bool tooSmall = cellSize * view.pixelsPerMetre() < kLeastCellPixels;
  const glm::dvec2 a = view.worldFromScreen(view.areaMin());
  const glm::dvec2 b = view.worldFromScreen(view.areaMin() + view.areaSize());
  const ui::CanvasBox visible{glm::min(a, b), glm::max(a, b)};
  const ui::Palette* palette = &ui::currentPalette();
  if (layout_ == layout && palette_ == palette && (tooSmall ? cells_.empty() : within(visible, sought_)))
    return;
  layout_ = layout;
  palette_ = palette;
  cells_.clear();
  sought_ = {};
  if (!tooSmall) {
    // Half a window further on each side, so that small moves find them there.
    const glm::dvec2 size = visible.high - visible.low;
    const double roomy = 4 * size.x * size.y / (kLeastCellArea * cellSize * cellSize);
    const glm::dvec2 margin = roomy < kMostCells ? 0.5 * size : 0.05 * size;
    sought_ = {visible.low - margin, visible.high + margin};
    for (LatticeCell& cell : cellsIn(layout->spec, sought_.low, sought_.high, kMostCells))
      if (!layout->findRegion(cell.id)) cells_.push_back(std::move(cell));
  }
  std::vector<const ConvexPolygon*> polygons;
  polygons.reserve(cells_.size());
  for (const LatticeCell& cell : cells_) polygons.push_back(&cell.polygon);
  setPolygons(mesh_, polygons);
  mesh_.setStyles(
      std::vector<ui::PolygonStyle>(cells_.size(), {0, ui::palette::text.withOpacity(0.08F).packed(), 1}));
}

void FreeCells::draw(ImDrawList& list, const ui::CanvasView& view) {
  if (!layout_) return;
  mesh_.draw(list, view,
             fadeIn(layout_->spec.cellSize * view.pixelsPerMetre(), kLeastCellPixels, kWholeFromPixels));
}

}  // namespace acentric::editor
