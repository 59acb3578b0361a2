#include "engine/export/region_order.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace acentric {
namespace {

/// Of an edge's length: borders that rounding set apart touch.
constexpr double kSlack = 1e-6;

struct Box {
  glm::dvec2 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
};

Box boxOf(const ConvexPolygon& polygon) {
  Box box;
  for (const glm::dvec2& corner : polygon.corners)
    box.low = glm::min(box.low, corner), box.high = glm::max(box.high, corner);
  return box;
}

/// Does a side of `a` lie between the two?
bool parts(const ConvexPolygon& a, const ConvexPolygon& b, double slack) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const glm::dvec2 from = a.corners[i];
    const glm::dvec2 along = glm::normalize(a.corners[(i + 1) % a.size()] - from);
    if (std::ranges::all_of(b.corners, [&](const glm::dvec2& p) {
          return along.y * (p.x - from.x) - along.x * (p.y - from.y) > slack;
        }))
      return true;
  }
  return false;
}

}  // namespace

std::vector<int> searchOrder(const Layout& layout) {
  std::vector<int> order(layout.regions.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_partition(order,
                                [&](int r) { return layout.regions[std::size_t(r)].id.slot == kFreeSlot; });
  return order;
}

std::vector<std::vector<int>> touching(const std::vector<Region>& regions) {
  std::vector<Box> boxes;
  for (const Region& region : regions) boxes.push_back(boxOf(region.polygon));
  std::vector<std::size_t> byLeft(regions.size());
  std::iota(byLeft.begin(), byLeft.end(), std::size_t(0));
  std::ranges::stable_sort(byLeft, {}, [&](std::size_t r) { return boxes[r].low.x; });
  std::vector<std::vector<int>> near(regions.size());
  for (std::size_t i = 0; i < byLeft.size(); ++i) {
    const std::size_t a = byLeft[i];
    const ConvexPolygon& polygon = regions[a].polygon;
    const double slack = kSlack * glm::distance(polygon.corners[0], polygon.corners[1]);
    for (std::size_t j = i + 1; j < byLeft.size(); ++j) {
      const std::size_t b = byLeft[j];
      if (boxes[b].low.x > boxes[a].high.x + slack) break;
      if (boxes[b].low.y > boxes[a].high.y + slack || boxes[a].low.y > boxes[b].high.y + slack) continue;
      if (parts(polygon, regions[b].polygon, slack) || parts(regions[b].polygon, polygon, slack)) continue;
      near[a].push_back(int(b)), near[b].push_back(int(a));
    }
  }
  for (auto& list : near) std::ranges::sort(list);
  return near;
}

}  // namespace acentric
