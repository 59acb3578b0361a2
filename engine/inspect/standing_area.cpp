#include "engine/inspect/standing_area.h"

#include <algorithm>
#include <cmath>

#include "engine/base/contract.h"

namespace acentric {
namespace {

/// Of a side of the area's box: finer lattices are not asked for.
constexpr int kMostSteps = 2000;
constexpr int kHalvings = 40;

std::size_t distanceBetween(std::size_t a, std::size_t b) { return a > b ? a - b : b - a; }

}  // namespace

StandingArea standingAreaOf(const Layout& layout) {
  StandingArea area;
  const Outline& outline = layout.spec.outline;
  if (outline.empty()) return area;
  area.low = area.high = outline.loops.front().front();
  for (const auto& loop : outline.loops)
    for (const glm::dvec2& corner : loop)
      area.low = min(area.low, corner), area.high = max(area.high, corner);
  area.contains = [&layout](const glm::dvec2& point) {
    return layout.spec.outline.contains(point) && layout.regionAt(point).has_value();
  };
  return area;
}

std::vector<glm::dvec2> latticeIn(const StandingArea& area, double spacing) {
  require(spacing > 0, "points lie some distance apart");
  std::vector<glm::dvec2> points;
  if (area.empty()) return points;
  const glm::dvec2 size = area.high - area.low, count = max(floor(size / spacing), glm::dvec2(1));
  const glm::dvec2 first = area.low + 0.5 * (size - (count - 1.0) * spacing);
  for (int y = 0; y < int(count.y); ++y)
    for (int x = 0; x < int(count.x); ++x)
      if (const glm::dvec2 point = first + spacing * glm::dvec2(x, y); area.contains(point))
        points.push_back(point);
  return points;
}

std::vector<glm::dvec2> gridIn(const StandingArea& area, std::size_t count) {
  if (area.empty() || count == 0) return {};
  const double side = std::max(area.high.x - area.low.x, area.high.y - area.low.y);
  double fine = side / kMostSteps, coarse = side;
  std::vector<glm::dvec2> best;
  for (int n = 0; n < kHalvings && best.size() != count; ++n) {
    const double spacing = std::sqrt(fine * coarse);
    auto points = latticeIn(area, spacing);
    (points.size() >= count ? fine : coarse) = spacing;
    if (!points.empty() &&
        (best.empty() || distanceBetween(points.size(), count) < distanceBetween(best.size(), count)))
      best = std::move(points);
  }
  return best;
}

}  // namespace acentric
