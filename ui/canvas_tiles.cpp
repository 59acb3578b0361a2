#include "ui/canvas_tiles.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace acentric::ui {

CanvasTiles tilesOf(std::span<const CanvasBox> boxes, std::size_t perTile) {
  CanvasTiles out;
  if (boxes.empty()) return out;
  glm::dvec2 low = boxes.front().low, high = boxes.front().low;
  for (const CanvasBox& box : boxes) {
    const glm::dvec2 centre = 0.5 * (box.low + box.high);
    low = glm::min(low, centre);
    high = glm::max(high, centre);
  }
  // Square cells of a grid over all centres; things spread unevenly make uneven tiles, which is no harm.
  const double wanted = std::max(1.0, double(boxes.size()) / double(perTile));
  const glm::dvec2 size = glm::max(high - low, glm::dvec2(1e-9));
  const double edge = std::max(std::sqrt(size.x * size.y / wanted), std::max(size.x, size.y) / 1024);
  const auto columns = std::uint32_t(size.x / edge) + 1;
  std::vector<std::uint32_t> cellOf(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const glm::dvec2 at = (0.5 * (boxes[i].low + boxes[i].high) - low) / edge;
    cellOf[i] = std::uint32_t(at.y) * columns + std::uint32_t(at.x);
  }
  // Sorted by counting: plans of some hundred thousand things are sorted while someone waits for their edit.
  std::vector<std::uint32_t> begins(1 + std::size_t(*std::ranges::max_element(cellOf)) + 1, 0);
  for (const std::uint32_t cell : cellOf) ++begins[cell + 1];
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  out.order.resize(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i) out.order[begins[cellOf[i]]++] = i;
  for (std::uint32_t n = 0; n < out.order.size(); ++n) {
    const std::uint32_t thing = out.order[n];
    if (n == 0 || cellOf[thing] != cellOf[out.order[n - 1]]) out.tiles.push_back({{}, boxes[thing], n, 0});
    CanvasTile& tile = out.tiles.back();
    tile.box.low = glm::min(tile.box.low, boxes[thing].low);
    tile.box.high = glm::max(tile.box.high, boxes[thing].high);
    ++tile.count;
  }
  for (CanvasTile& tile : out.tiles) tile.origin = 0.5 * (tile.box.low + tile.box.high);
  return out;
}

bool onScreen(const CanvasView& view, const CanvasBox& box, double marginPixels) {
  const glm::dvec2 a = view.screenFromWorld(box.low);
  const glm::dvec2 b = view.screenFromWorld(box.high);
  const glm::dvec2 min = view.areaMin() - marginPixels;
  const glm::dvec2 max = view.areaMin() + view.areaSize() + marginPixels;
  return b.x >= min.x && a.x <= max.x && a.y >= min.y && b.y <= max.y;  // y turns over
}

}  // namespace acentric::ui
