#include "engine/inspect/lattice_shift.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/round_to.h"
#include "engine/inspect/placement_checks.h"

namespace acentric {
namespace {

constexpr int kSides = 12;
constexpr double kInside = 0.8;  // share of the sides that show backs

double lackOf(const glm::dvec3& centre, double eyeHeight, const CrowdingRules& rules,
              const SurfaceProbe& probe) {
  double nearest = rules.cameraRoom;
  int backs = 0;
  for (int k = 0; k < kSides; ++k) {
    const glm::dvec3 direction(directionOf(kTwoPi * k / kSides), 0);
    const SurfaceHit hit = probe(centre, direction);
    if (!hit.found()) continue;
    nearest = std::min(nearest, hit.distance);
    backs += hit.showsBack(direction) ? 1 : 0;
  }
  if (rules.trustSides && backs >= kInside * kSides) return 2;
  if (!(probe(centre, {0, 0, -1}).distance <= eyeHeight + rules.floorTolerance)) return 2;
  return 1 - nearest / rules.cameraRoom;
}

}  // namespace

double crowding(const Layout& layout, const CrowdingRules& rules, const SurfaceProbe& probe) {
  double sum = 0;
  for (const CameraCentre& centre : centresOf(layout))
    sum += double(centre.cameras.size()) *
           lackOf({centre.position, layout.eyeZ()}, layout.spec.eyeHeight, rules, probe);
  return sum;
}

LatticeShift findFreestOrigin(const LayoutSpec& spec, const ShiftOptions& options, const SurfaceProbe& probe,
                              std::stop_token stop) {
  std::size_t cameras = 1;  // of the layout looked at last
  const auto crowdingAt = [&](const glm::dvec2& origin) {
    LayoutSpec moved = spec;
    moved.latticeOrigin = origin;
    const auto layout = buildLayout(moved);
    if (!layout || layout->regions.empty()) return std::numeric_limits<double>::infinity();
    cameras = std::max(cameras, layout->cameras.size());
    return crowding(*layout, options.crowding, probe);
  };
  LatticeShift best{spec.latticeOrigin, crowdingAt(spec.latticeOrigin), 0};
  best.after = best.before;
  // The lattice repeats along the way from one cell to the next: origins within that parallelogram are all.
  const glm::dvec2 middle = cellPolygon(spec, {0, 0, 0}).centroid();
  const glm::dvec2 along = cellPolygon(spec, {1, 0, 0}).centroid() - middle;
  const glm::dvec2 across = cellPolygon(spec, {0, 1, 0}).centroid() - middle;
  const int steps = std::min(options.steps, int(std::sqrt(double(options.mostCameras) / double(cameras))));
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      if (stop.stop_requested() || best.after == 0) return best;
      const glm::dvec2 to = spec.latticeOrigin + (along * double(i) + across * double(j)) / double(steps);
      const glm::dvec2 origin(roundTo(to.x, options.rounding), roundTo(to.y, options.rounding));
      const double crowded = crowdingAt(origin);
      if (crowded < best.after - 1e-9) best.origin = origin, best.after = crowded;
    }
  return best;
}

}  // namespace acentric
