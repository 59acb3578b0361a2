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

constexpr int kEnoughSteps = 8, kEnoughDoors = 3;
constexpr double kMostly = 0.5;  // share of what was found that is alike
constexpr double kRiserMetres = 0.17, kDoorMetres = 2.1;
constexpr double kLeastRiser = 0.08, kLargestRiser = 0.35;            // metres: people climb these
constexpr double kTinyRiser = 0.03, kHugeRiser = 1.05;                // metres: no terrace of blocks either
constexpr double kLeastRiserShare = 0.008, kLargestRiserShare = 0.2;  // of the rooms' height
constexpr double kLeastDoorShare = 0.12;                              // of the rooms' height
constexpr double kLowDoor = 1.5, kHighDoor = 4;                       // metres: people pass these
constexpr double kLowestDoor = 1.2, kHighestGate = 6.5;               // metres: no hatch or gate either
constexpr double kAgree = 2.5;  // factor between the scales that two findings ask for

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
  ScaleEvidence evidence{1, {{"it is", across, "across"}}};
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

/// Something of a known size, and how sure that size is.
struct Clue {
  ScaleFinding finding;
  double expected;  ///< metres
  double spread;    ///< of its natural logarithm
  double factor() const { return expected / finding.metres; }
};

bool isCovered(const ScaleMeasures& m) { return m.headways.coveredShare >= kEnoughCovered; }

/// Furniture has mouldings and holes with the proportions of steps and doors; rooms tell them apart.
bool hasSteps(const ScaleMeasures& m) {
  const CommonLength& riser = m.built.riser;
  const double share = isCovered(m) ? riser.metres / m.headways.typical : kLeastRiserShare;
  return riser.count >= kEnoughSteps && riser.count >= kMostly * riser.of && share >= kLeastRiserShare &&
         share <= kLargestRiserShare;
}

bool hasDoors(const ScaleMeasures& m) {
  const CommonLength& door = m.built.doorHeight;
  return isCovered(m) && door.count >= kEnoughDoors && door.count >= kMostly * door.of &&
         door.metres >= kLeastDoorShare * m.headways.typical;
}

/// Do people climb the steps, or pass the doorways?
bool suitsPeople(const ScaleMeasures& m) {
  const double riser = m.built.riser.metres, door = m.built.doorHeight.metres;
  if (hasSteps(m) && riser >= kLeastRiser && riser <= kLargestRiser) return true;
  return hasDoors(m) && door >= kLowDoor && door <= kHighDoor;
}

/// What alone speaks against the scale, surest first.
std::vector<Clue> gatherClues(const ScaleMeasures& m) {
  const Headways& headways = m.headways;
  const double riser = m.built.riser.metres, door = m.built.doorHeight.metres;
  std::vector<Clue> clues;
  // Stands and terraces have large steps too: then the rooms have to be too high as well.
  const bool tooHigh = isCovered(m) && headways.typical > kMostFitting;
  const bool tooLow = isCovered(m) && headways.typical < kLeastFitting;
  if (hasSteps(m) &&
      (riser > (tooHigh ? kLargestRiser : kHugeRiser) || riser < (tooLow ? kLeastRiser : kTinyRiser)))
    clues.push_back({{"its steps are", riser, "high"}, kRiserMetres, 0.2});
  if (hasDoors(m) && (door < kLowestDoor || door > kHighestGate))
    clues.push_back({{"its doorways are", door, "high"}, kDoorMetres, 0.15});
  if (!isCovered(m)) return clues;
  const bool storeys = headways.stackedShare >= kStacked;
  if (storeys && headways.typical >= kHighStorey)
    clues.push_back({{"its storeys are", headways.storey, "high"}, kStoreyMetres, 0.2});
  else if (headways.typical <= kTooLow || headways.typical >= kHighHall)
    clues.push_back(
        {{"the spaces between its floors and ceilings are", headways.typical, "high"}, kHeadwayMetres, 0.6});
  return clues;
}

/// The scale that suits the clues best, of those that agree with the first.
ScaleEvidence combine(const std::vector<Clue>& clues) {
  ScaleEvidence evidence;
  double logarithms = 0, weights = 0;
  for (const Clue& clue : clues) {
    const double apart = clue.factor() / clues.front().factor();
    if (apart > kAgree || apart < 1 / kAgree) continue;
    const double weight = 1 / (clue.spread * clue.spread);
    logarithms += weight * std::log(clue.factor());
    weights += weight;
    evidence.findings.push_back(clue.finding);
  }
  evidence.factor = std::exp(logarithms / weights);
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

std::optional<ScaleEvidence> weighScale(const ScaleMeasures& measures) {
  if (suitsPeople(measures)) return std::nullopt;
  if (isCovered(measures) && measures.headways.fittingShare >= kFits) return std::nullopt;
  if (const auto clues = gatherClues(measures); !clues.empty()) return combine(clues);
  if (isCovered(measures)) return std::nullopt;
  return weighExtent(measures.across, measures.texelMetres);
}

}  // namespace acentric
