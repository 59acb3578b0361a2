#include "engine/inspect/floor_levels.h"

#include <algorithm>
#include <cmath>

namespace acentric {
namespace {

constexpr int kMostSurfaces = 64;  // along one ray: foliage and stacked shelves may have many

}  // namespace

FloorLevels findFloorLevels(const Bounds& bounds, const ProbeGrid& grid, double headRoom,
                            const DistanceProbe& probe) {
  FloorLevels levels(std::size_t(grid.columns) * std::size_t(grid.rows));
  const double top = double(bounds.max.z) + 1, bottom = bounds.min.z;
  // Far enough past a surface that single precision does not meet it again.
  const double skip = std::max(1e-4, 4e-6 * std::max(std::abs(top), std::abs(bottom)));
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x) {
      auto& here = levels[std::size_t(y) * std::size_t(grid.columns) + std::size_t(x)];
      double from = top, ceiling = std::numeric_limits<double>::infinity();
      for (int surface = 0; surface < kMostSurfaces && from > bottom - skip; ++surface) {
        const double distance = probe({grid.centreOf(x, y), from}, {0, 0, -1});
        if (!(distance >= 0 && std::isfinite(distance))) break;
        const double height = from - distance;
        if (ceiling - height >= headRoom) here.push_back(static_cast<float>(height));
        ceiling = height;
        from = height - skip;
      }
    }
  return levels;
}

std::optional<double> dominantLevel(const FloorLevels& levels, double tolerance) {
  std::vector<float> heights;
  for (const auto& here : levels) heights.insert(heights.end(), here.begin(), here.end());
  if (heights.empty()) return std::nullopt;
  std::ranges::sort(heights);
  // How many lie in [heights[k], heights[k] + tolerance].
  std::vector<std::size_t> within(heights.size());
  for (std::size_t k = 0, end = 0; k < heights.size(); ++k) {
    while (end < heights.size() && heights[end] <= heights[k] + tolerance) ++end;
    within[k] = end - k;
  }
  const double enough = 0.6 * double(std::ranges::max(within));
  std::size_t chosen = 0;
  while (double(within[chosen]) < enough) ++chosen;
  // On to the fullest window that still overlaps this one.
  for (std::size_t k = chosen, end = chosen + within[chosen]; k < end; ++k)
    if (within[k] > within[chosen]) chosen = k;
  return heights[chosen + within[chosen] / 2];
}

}  // namespace acentric
