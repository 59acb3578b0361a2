#include "engine/inspect/scale_doubt.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace acentric {
namespace {

constexpr int kColumns = 96;       // along the longer side of the plan
constexpr int kMostSurfaces = 64;  // along one ray
constexpr double kLevel = 0.7;     // cosine of the slope that a floor or a ceiling may have

constexpr double kLeastFitting = 1.9, kMostFitting = 6;  // metres of headway
constexpr double kFits = 0.2;           // share of fitting headways with which no scale is doubted
constexpr double kEnoughCovered = 0.1;  // share of columns, for headways to tell anything
constexpr double kTooLow = 1.2;         // metres: nobody stands there
constexpr double kHighStorey = 7;       // metres: halls are higher, but not one above another
constexpr double kHighHall = 60;        // metres: nor are halls this high
constexpr double kStacked = 0.3;        // share of covered columns that makes storeys
constexpr double kStoreyMetres = 3, kHeadwayMetres = 2.7;      // as people build
constexpr double kLargestScene = 20000, kSmallestScene = 0.5;  // metres across: nobody walks through
constexpr double kLargestWalk = 2000, kSmallestWalk = 3;       // metres across, with a scale that fits
constexpr double kTexelMetres = 0.005;                         // of textures made for walking by

struct Space {
  double floor, ceiling;
  double height() const { return ceiling - floor; }
};

/// The spaces over one place, highest first: from a surface that faces up to the next one above, if that
/// faces down.
std::vector<Space> spacesAt(const glm::dvec2& place, const Bounds& bounds, const SurfaceProbe& probe) {
  const double top = double(bounds.max.z) + 1, bottom = bounds.min.z;
  // Far enough past a surface that single precision does not meet it again.
  const double skip =
      std::max(1e-5 * double(bounds.size().z), 4e-6 * std::max(std::abs(top), std::abs(bottom)));
  std::vector<Space> spaces;
  double from = top, ceiling = 0;
  bool below = false;
  for (int surface = 0; surface < kMostSurfaces && from > bottom - skip; ++surface) {
    const SurfaceHit hit = probe({place, from}, {0, 0, -1});
    if (!hit.found()) break;
    const double height = from - hit.distance;
    if (below && hit.normal.z > kLevel && ceiling - height > 4 * skip) spaces.push_back({height, ceiling});
    below = hit.normal.z < -kLevel;
    ceiling = height;
    from = height - skip;
  }
  return spaces;
}

double middleOf(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

void measureStacks(const std::vector<std::vector<Space>>& columns, Headways& out) {
  const auto typical = [&](const Space& space) {
    return space.height() > 0.7 * out.typical && space.height() < 1.4 * out.typical;
  };
  std::vector<double> storeys;
  int stacked = 0;
  for (const auto& spaces : columns) {
    const std::size_t before = storeys.size();
    for (std::size_t k = 1; k < spaces.size(); ++k) {
      // Between storeys there is a slab; more than that is something else.
      const double slab = spaces[k - 1].floor - spaces[k].ceiling;
      if (typical(spaces[k - 1]) && typical(spaces[k]) && slab < 0.4 * out.typical)
        storeys.push_back(spaces[k - 1].floor - spaces[k].floor);
    }
    stacked += storeys.size() > before ? 1 : 0;
  }
  out.stackedShare = double(stacked) / double(columns.size());
  out.storey = middleOf(storeys);
}

/// Where little is covered: only what no one walks through is doubted.
std::optional<ScaleEvidence> weighExtent(double across, double texelMetres) {
  if (across <= kLargestScene && across >= kSmallestScene) return std::nullopt;
  ScaleEvidence evidence{1, across, "it is", "across"};
  if (across < kSmallestScene) {
    while (across * evidence.factor < kSmallestWalk) evidence.factor *= 10;
    return evidence;
  }
  while (across * evidence.factor > kLargestWalk) evidence.factor /= 10;
  const auto distance = [&](double factor) {
    return std::abs(std::log(texelMetres * factor / kTexelMetres));
  };
  for (double factor = evidence.factor; texelMetres > 0 && across * factor / 10 >= 10 * kSmallestWalk;) {
    factor /= 10;
    if (distance(factor) < distance(evidence.factor)) evidence.factor = factor;
  }
  return evidence;
}

}  // namespace

Headways measureHeadways(const Bounds& bounds, const SurfaceProbe& probe) {
  const glm::dvec3 low(bounds.min), size(bounds.size());
  Headways found;
  if (bounds.empty() || !(size.x > 0 && size.y > 0 && size.z > 0)) return found;
  const double step = std::max(size.x, size.y) / kColumns;
  const int columns = std::max(1, static_cast<int>(size.x / step));
  const int rows = std::max(1, static_cast<int>(size.y / step));
  std::vector<std::vector<Space>> covered;
  std::vector<double> heights;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const glm::dvec2 place(low.x + (x + 0.5) * size.x / columns, low.y + (y + 0.5) * size.y / rows);
      auto spaces = spacesAt(place, bounds, probe);
      for (const Space& space : spaces) heights.push_back(space.height());
      if (!spaces.empty()) covered.push_back(std::move(spaces));
    }
  if (covered.empty()) return found;
  found.coveredShare = double(covered.size()) / (columns * rows);
  found.typical = middleOf(heights);
  found.fittingShare =
      double(std::ranges::count_if(
          heights, [](double height) { return height >= kLeastFitting && height <= kMostFitting; })) /
      double(heights.size());
  measureStacks(covered, found);
  return found;
}

std::optional<ScaleEvidence> weighScale(const Bounds& bounds, const SurfaceProbe& probe, double texelMetres) {
  const Headways headways = measureHeadways(bounds, probe);
  if (headways.coveredShare < kEnoughCovered)
    return weighExtent(glm::length(glm::dvec3(bounds.size())), texelMetres);
  if (headways.fittingShare >= kFits) return std::nullopt;
  const bool storeys = headways.stackedShare >= kStacked;
  if (storeys && headways.typical >= kHighStorey)
    return ScaleEvidence{kStoreyMetres / headways.storey, headways.storey, "its storeys are", "high"};
  if (headways.typical <= kTooLow || headways.typical >= kHighHall)
    return ScaleEvidence{kHeadwayMetres / headways.typical, headways.typical,
                         "the spaces between its floors and ceilings are", "high"};
  return std::nullopt;
}

}  // namespace acentric
