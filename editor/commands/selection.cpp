#include "editor/commands/selection.h"

#include <algorithm>
#include <unordered_set>

namespace acentric::editor {

std::set<CellId> combined(const std::set<CellId>& before, const std::vector<CellId>& cells, Combine how) {
  if (how == Combine::replace) return {cells.begin(), cells.end()};
  std::set<CellId> after = before;
  for (const CellId& cell : cells)
    if (!after.insert(cell).second && how == Combine::toggle) after.erase(cell);
  return after;
}

bool touches(const ConvexPolygon& polygon, const glm::dvec2& low, const glm::dvec2& high) {
  glm::dvec2 least(polygon.corners.front()), most(least);
  for (const glm::dvec2& corner : polygon.corners)
    least = glm::min(least, corner), most = glm::max(most, corner);
  if (least.x > high.x || most.x < low.x || least.y > high.y || most.y < low.y) return false;
  if (least.x >= low.x && most.x <= high.x && least.y >= low.y && most.y <= high.y) return true;
  return overlap(polygon, {{low, {high.x, low.y}, high, {low.x, high.y}}});
}

std::vector<CellId> cellsTouching(const Layout& layout, const glm::dvec2& low, const glm::dvec2& high) {
  std::vector<CellId> cells;
  for (const Region& region : layout.regions)
    if (touches(region.polygon, low, high)) cells.push_back(region.id);
  return cells;
}

std::set<CellId> cellsWhere(const Layout& layout, const std::function<bool(std::size_t)>& holds) {
  std::set<CellId> cells;
  for (std::size_t r = 0; r < layout.regions.size(); ++r)
    if (holds(r)) cells.insert(layout.regions[r].id);
  return cells;
}

std::set<CellId> inverted(const Layout& layout, const std::set<CellId>& selection) {
  return cellsWhere(layout, [&](std::size_t r) { return !selection.contains(layout.regions[r].id); });
}

std::set<CellId> overBudget(const Layout& layout, const RegionBudgets& budgets, std::size_t limit) {
  return cellsWhere(layout, [&](std::size_t r) { return budgets.triangles[r] > limit; });
}

std::set<CellId> withWarnings(const Layout& layout, const PlacementReport& report) {
  std::unordered_set<int> regions, cameras;
  for (const PlacementFinding& finding : report.findings) {
    if (finding.severity == Severity::note) continue;
    if (finding.region >= 0) regions.insert(finding.region);
    cameras.insert(finding.cameras.begin(), finding.cameras.end());
  }
  return cellsWhere(layout, [&](std::size_t r) {
    return regions.contains(int(r)) || std::ranges::any_of(layout.regions[r].covers, [&](const Cover& cover) {
             return std::ranges::any_of(cover.pieces,
                                        [&](const Piece& piece) { return cameras.contains(piece.camera); });
           });
  });
}

}  // namespace acentric::editor
