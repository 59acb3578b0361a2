#include "engine/inspect/floor_levels.h"

#include <algorithm>
#include <cmath>

namespace acentric {
namespace {

constexpr int kMostSurfaces = 64;  // along one ray: foliage and stacked shelves may have many
constexpr double kSteepest = 0.5;  // |cosine| of a floor's slope

/// Solids entered less solids left on the way down. A sheet that faces up is entered and never left.
class Solids {
 public:
  void pass(const SurfaceHit& hit) {
    if (hit.normal.z > 0) ++depth_;
    if (hit.normal.z < 0) depth_ = std::max(0, depth_ - 1);
  }
  bool outside() const { return depth_ == 0; }

 private:
  int depth_ = 0;
};

bool isSteep(const SurfaceHit& hit) {
  return hit.normal != glm::dvec3(0) && std::abs(hit.normal.z) < kSteepest;
}

}  // namespace

std::vector<FloorLevel> floorLevelsAt(const glm::dvec2& place, const Bounds& bounds, double headRoom,
                                      const SurfaceProbe& probe) {
  const double top = double(bounds.max.z) + 1, bottom = bounds.min.z;
  // Far enough past a surface that single precision does not meet it again.
  const double skip = std::max(1e-4, 4e-6 * std::max(std::abs(top), std::abs(bottom)));
  std::vector<FloorLevel> levels;
  double from = top, ceiling = std::numeric_limits<double>::infinity();
  bool ceilingIsBack = false;
  Solids solids;
  for (int surface = 0; surface < kMostSurfaces && from > bottom - skip; ++surface) {
    const SurfaceHit hit = probe({place, from}, {0, 0, -1});
    if (!hit.found()) break;
    const double height = from - hit.distance;
    if (ceiling - height >= headRoom && !isSteep(hit)) {
      const bool faceDown = hit.normal.z < 0;
      levels.push_back({static_cast<float>(height), std::isfinite(ceiling), faceDown,
                        ceilingIsBack || (faceDown && !solids.outside())});
    }
    solids.pass(hit);
    ceiling = height;
    ceilingIsBack = hit.normal.z > 0;
    from = height - skip;
  }
  return levels;
}

FloorLevels findFloorLevels(const Bounds& bounds, const ProbeGrid& grid, double headRoom,
                            const SurfaceProbe& probe) {
  FloorLevels levels(std::size_t(grid.columns) * std::size_t(grid.rows));
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x)
      levels[grid.index(x, y)] = floorLevelsAt(grid.centreOf(x, y), bounds, headRoom, probe);
  return levels;
}

std::optional<double> dominantHeight(std::vector<WeightedHeight> heights, double tolerance) {
  if (heights.empty()) return std::nullopt;
  std::ranges::sort(heights, {}, &WeightedHeight::height);
  std::vector<double> before{0};  // weight of heights[0..k)
  for (const WeightedHeight& height : heights) before.push_back(before.back() + height.weight);
  // Of the heights in [heights[k], heights[k] + tolerance]: one past the last, and their weight.
  std::vector<std::size_t> ends(heights.size());
  std::vector<double> within(heights.size());
  for (std::size_t k = 0, end = 0; k < heights.size(); ++k) {
    while (end < heights.size() && double(heights[end].height) <= double(heights[k].height) + tolerance)
      ++end;
    ends[k] = end;
    within[k] = before[end] - before[k];
  }
  const double enough = 0.6 * std::ranges::max(within);
  std::size_t chosen = 0;
  while (within[chosen] < enough) ++chosen;
  // On to the fullest window that still overlaps this one.
  for (std::size_t k = chosen, end = ends[chosen]; k < end; ++k)
    if (within[k] > within[chosen]) chosen = k;
  double pull = 0;
  for (std::size_t k = chosen; k < ends[chosen]; ++k) pull += heights[k].pull;
  std::size_t middle = chosen;
  for (double passed = heights[chosen].pull; middle + 1 < ends[chosen] && passed < 0.5 * pull;
       passed += heights[middle].pull)
    ++middle;
  return double(heights[middle].height);
}

}  // namespace acentric
