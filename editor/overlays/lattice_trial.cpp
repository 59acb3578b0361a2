#include "editor/overlays/lattice_trial.h"

#include "editor/overlays/free_cells.h"
#include "editor/overlays/plan_layers.h"
#include "engine/base/contract.h"
#include "engine/layout/lattice.h"
#include "engine/layout/placement.h"
#include "ui/canvas_draw.h"

namespace acentric::editor {

void LatticeTrial::draw(ImDrawList& list, const ui::CanvasView& view, const LayoutSpec& spec) {
  if (spec.cellSize * view.pixelsPerMetre() < kLeastCellPixels) return;
  const glm::dvec2 a = view.worldFromScreen(view.areaMin());
  const glm::dvec2 b = view.worldFromScreen(view.areaMin() + view.areaSize());
  const ui::CanvasBox visible{glm::min(a, b), glm::max(a, b)};
  if (shown_ != spec || visible.low != visible_.low || visible.high != visible_.high) {
    shown_ = spec;
    send(visible);
  }
  mesh_.draw(list, view, 1);
}

void LatticeTrial::send(const ui::CanvasBox& visible) {
  constexpr int kMostCells = 10'000;
  namespace palette = ui::palette;
  visible_ = visible;
  const auto lattice = Lattice::of(*shown_);
  require(lattice.has_value(), "a project's configuration has a lattice");
  const std::vector<LatticeCell> cells = cellsIn(*shown_, visible.low, visible.high, kMostCells);
  std::vector<const ConvexPolygon*> polygons;
  std::vector<ui::PolygonStyle> styles;
  for (const LatticeCell& cell : cells) {
    polygons.push_back(&cell.polygon);
    const bool placed = isPlaced(*shown_, *lattice, cell.id);
    const bool ring = cell.kind == RegionKind::ring;
    styles.push_back(placed ? ui::PolygonStyle{palette::accent.withOpacity(ring ? 0.22F : 0.12F).packed(),
                                               palette::accent.withOpacity(0.9F).packed(), 1.4F}
                            : ui::PolygonStyle{0, palette::text.withOpacity(0.16F).packed(), 1});
  }
  setPolygons(mesh_, polygons);
  mesh_.setStyles(styles);
}

}  // namespace acentric::editor
