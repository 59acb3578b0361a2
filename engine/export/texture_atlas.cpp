#include "engine/export/texture_atlas.h"

#include <algorithm>
#include <numeric>

#include "engine/base/contract.h"

namespace acentric {

AtlasPlan planAtlas(std::span<const glm::ivec2> sizes, int side, int border) {
  AtlasPlan plan;
  plan.places.resize(sizes.size());
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return sizes[a].y > sizes[b].y; });
  glm::ivec2 next(0);
  int shelf = 0;
  for (const std::size_t i : order) {
    const glm::ivec2 size = sizes[i] + 2 * border;
    require(size.x <= side && size.y <= side, "a picture fits a page");
    if (next.x + size.x > side) next = {0, next.y + shelf}, shelf = 0;
    if (plan.pages.empty() || next.y + size.y > side) {
      plan.pages.emplace_back(0);
      next = glm::ivec2(0);
      shelf = 0;
    }
    plan.places[i] = {int(plan.pages.size()) - 1, next + border};
    plan.pages.back() = glm::max(plan.pages.back(), next + size);
    shelf = std::max(shelf, size.y);
    next.x += size.x;
  }
  return plan;
}

}  // namespace acentric
