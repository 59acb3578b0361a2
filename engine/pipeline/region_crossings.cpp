#include "engine/pipeline/region_crossings.h"

#include <cmath>

#include "engine/geometry/conventions.h"

namespace acentric {
namespace {

constexpr double kApart = 1e-7;  ///< metres
constexpr std::size_t kMost = 10'000;

PathPose poseBetween(const PathPose& a, const PathPose& b, double share) {
  const double turn = std::remainder(b.yawRadians - a.yawRadians, kTwoPi);
  return {glm::mix(a.eye, b.eye, share), a.yawRadians + share * turn,
          glm::mix(a.pitchRadians, b.pitchRadians, share)};
}

}  // namespace

std::vector<RegionCrossing> crossingsBetween(const Layout& layout, const PathPose& a, const PathPose& b) {
  const auto regionAt = [&](double share) {
    return layout.regionAt(glm::dvec2(poseBetween(a, b, share).eye));
  };
  const double length = glm::distance(a.eye, b.eye);
  std::vector<RegionCrossing> crossings;
  double here = 0;
  auto region = regionAt(here);
  while (region && regionAt(1) != region && crossings.size() < kMost) {
    double inside = here, beyond = 1;  // regions are convex: what lies between is left once
    for (;;) {
      const double middle = 0.5 * (inside + beyond);
      if ((beyond - inside) * length < kApart || middle <= inside || middle >= beyond) break;
      (regionAt(middle) == region ? inside : beyond) = middle;
    }
    const auto next = regionAt(beyond);
    if (!next) break;
    crossings.push_back({poseBetween(a, b, inside), poseBetween(a, b, beyond), *region, *next, inside});
    here = beyond;
    region = next;
  }
  return crossings;
}

}  // namespace acentric
