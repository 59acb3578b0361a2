#include "engine/bake/pruning_loss.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/bake/eye_views.h"
#include "engine/bake/region_sight.h"
#include "engine/bake/surface_side.h"
#include "engine/geometry/conventions.h"

namespace acentric {
namespace {

constexpr double kMissedLimits = 0.05;         // of limits are below the share they are of
const double kHighestSine = std::sqrt(0.5);    // of a look's elevation
constexpr double kWhole = 9007199254740992.0;  // 2^53

/// Uniform in [0, 1), the same on every machine.
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : engine_(seed) {}
  double next() { return double(engine_() >> 11) / kWhole; }
  double in(double low, double high) { return low + (high - low) * next(); }

 private:
  std::mt19937_64 engine_;
};

glm::dvec2 placeIn(const ConvexPolygon& polygon, Uniform& random) {
  glm::dvec2 low = polygon.corners.front(), high = low;
  for (const glm::dvec2& corner : polygon.corners) low = glm::min(low, corner), high = glm::max(high, corner);
  constexpr int kMostTries = 1000;  // a sliver gets its centroid
  for (int n = 0; n < kMostTries; ++n) {
    const double x = random.in(low.x, high.x), y = random.in(low.y, high.y);
    if (polygon.contains({x, y})) return {x, y};
  }
  return polygon.centroid();
}

/// Chance of no more than `lost` losses in so many looks, if each loses with probability p.
double chanceOfSoFew(const PruningLoss& loss, double p) {
  const double n = double(loss.looks), logP = std::log(p), logQ = std::log1p(-p);
  double sum = 0;
  for (std::uint64_t k = 0; k <= loss.lost; ++k) {
    const double i = double(k);
    sum += std::exp(std::lgamma(n + 1) - std::lgamma(i + 1) - std::lgamma(n - i + 1) + i * logP +
                    (n - i) * logQ);
  }
  return sum;
}

}  // namespace

double PruningLoss::atMost() const {
  if (lost >= looks) return 1;
  double low = share(), high = 1;
  while (high - low > 1e-6 * high) {
    const double middle = 0.5 * (low + high);
    (chanceOfSoFew(*this, middle) > kMissedLimits ? low : high) = middle;
  }
  return high;
}

PruningLoss& PruningLoss::operator+=(const PruningLoss& other) {
  looks += other.looks;
  lost += other.lost;
  return *this;
}

PruningLoss pruningLoss(const RayScene& scene, const Region& region, double eyeZ,
                        const BakeSettings& settings, int looks, std::uint64_t seed) {
  PruningLoss loss;
  std::vector<std::shared_ptr<const EyeView>> views;
  for (const glm::dvec3& eye : testEyes(region.polygon, eyeZ, settings))
    views.push_back(EyeView::untraced(eye));
  const double nearer = std::max(kSameDepth * radians(1 / settings.samplesPerDegree), kSameSurface);
  Uniform random(seed);
  RayCounts rays;
  std::size_t hint = 0;  // which answered last
  for (int n = 0; n < looks; ++n) {
    const glm::dvec3 eye(placeIn(region.polygon, random),
                         random.in(eyeZ - settings.eyeRange, eyeZ + settings.eyeRange));
    const double up = random.in(-kHighestSine, kHighestSine);
    const glm::dvec3 direction(std::sqrt(1 - up * up) * directionOf(random.in(0, kTwoPi)), up);
    ++loss.looks;
    const Hit hit = scene.traceSolid({glm::vec3(eye), glm::vec3(direction)});
    if (!hit.found()) continue;
    const glm::dvec3 point = eye + double(hit.distance) * direction;
    if (region.grown.containsClosed(glm::dvec2(point))) continue;
    const MetSurface surface(hit, point, glm::vec3(direction));
    const auto sees = [&](std::size_t e) {
      return surface.sideOf(views[e]->eye()) == Side::met &&
             seesPoint(scene, *views[e], point, nearer * double(hit.distance), rays);
    };
    if (hint < views.size() && sees(hint)) continue;
    std::size_t e = 0;
    while (e < views.size() && (e == hint || !sees(e))) ++e;
    if (e < views.size())
      hint = e;
    else
      ++loss.lost;
  }
  return loss;
}

}  // namespace acentric
