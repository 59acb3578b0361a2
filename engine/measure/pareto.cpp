#include "engine/measure/pareto.h"

#include <algorithm>
#include <numeric>

#include "engine/base/contract.h"

namespace acentric {

bool dominates(const Objectives& a, const Objectives& b) {
  require(a.size() == b.size(), "points are compared in the same respects");
  bool better = false;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k] > b[k]) return false;
    better = better || a[k] < b[k];
  }
  return better;
}

std::vector<std::size_t> paretoFront(std::span<const Objectives> points) {
  // In lexical order whatever dominates a point comes before it, and something of the front does so too.
  std::vector<std::size_t> order(points.size()), front;
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::ranges::stable_sort(order, {}, [&](std::size_t i) -> const Objectives& { return points[i]; });
  for (const std::size_t i : order)
    if (std::ranges::none_of(front, [&](std::size_t f) { return dominates(points[f], points[i]); }))
      front.push_back(i);
  std::ranges::sort(front);
  return front;
}

}  // namespace acentric
