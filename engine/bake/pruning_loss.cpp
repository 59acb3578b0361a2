#include "engine/bake/pruning_loss.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/bake/eye_views.h"
#include "engine/bake/flush_denormals.h"
#include "engine/bake/region_sight.h"
#include "engine/base/hash.h"
#include "engine/geometry/conventions.h"

namespace acentric {
namespace {

constexpr std::size_t kLooksAtOnce = 500;      // looks of one piece of work
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

struct RandomLooks::Batch {
  PruningLoss loss;
  std::vector<Lost> lost;
  RayCounts rays;
};

RandomLooks::RandomLooks(const RayScene& scene, const ConvexPolygon& polygon, const ConvexPolygon& grown,
                         double eyeZ, const BakeSettings& settings)
    : scene_(scene),
      polygon_(polygon),
      grown_(grown),
      eyeZ_(eyeZ),
      eyeRange_(settings.eyeRange),
      nearer_(std::max(kSameDepth * radians(1 / settings.samplesPerDegree), kSameSurface)) {
  low_ = high_ = polygon.corners.front();
  for (const glm::dvec2& corner : polygon.corners)
    low_ = glm::min(low_, corner), high_ = glm::max(high_, corner);
}

PruningLoss RandomLooks::loss(std::span<const glm::dvec3> testEyes, std::size_t looks, std::uint64_t seed,
                              TaskRunner& runner, RayCounts& rays, std::vector<Lost>* lost,
                              const std::stop_token& stop) const {
  std::vector<Batch> batches((looks + kLooksAtOnce - 1) / kLooksAtOnce);
  runner.parallelFor(batches.size(), [&](std::size_t n) {
    if (stop.stop_requested()) return;
    const FlushDenormals flush;
    look(testEyes, std::min(kLooksAtOnce, looks - n * kLooksAtOnce),
         Hasher().value(seed).value(n).finish().low, batches[n]);
  });
  PruningLoss sum;
  for (Batch& batch : batches) {
    sum += batch.loss;
    rays += batch.rays;
    if (lost != nullptr) lost->insert(lost->end(), batch.lost.begin(), batch.lost.end());
  }
  return sum;
}

void RandomLooks::look(std::span<const glm::dvec3> testEyes, std::size_t looks, std::uint64_t seed,
                       Batch& batch) const {
  constexpr int kMostTries = 1000;  // a sliver gets its centroid
  Uniform random(seed);
  std::size_t hint = 0;  // which saw the last
  batch.loss.looks = looks;
  for (std::size_t n = 0; n < looks; ++n) {
    glm::dvec2 place = polygon_.centroid();
    for (int t = 0; t < kMostTries; ++t) {
      const double x = random.in(low_.x, high_.x), y = random.in(low_.y, high_.y);
      if (!polygon_.contains({x, y})) continue;
      place = {x, y};
      break;
    }
    const glm::dvec3 eye(place, random.in(eyeZ_ - eyeRange_, eyeZ_ + eyeRange_));
    const double up = random.in(-kHighestSine, kHighestSine);
    const glm::dvec3 direction(std::sqrt(1 - up * up) * directionOf(random.in(0, kTwoPi)), up);
    ++batch.rays.visibility;
    const Hit hit = scene_.traceSolid({glm::vec3(eye), glm::vec3(direction)});
    if (!hit.found()) continue;
    const glm::dvec3 point = eye + double(hit.distance) * direction;
    if (grown_.containsClosed(glm::dvec2(point))) continue;
    const Lost what{eye, MetSurface(hit, point, glm::vec3(direction)), nearer_ * double(hit.distance)};
    if (hint < testEyes.size() && sees(testEyes[hint], what, batch.rays)) continue;
    std::size_t e = 0;
    while (e < testEyes.size() && (e == hint || !sees(testEyes[e], what, batch.rays))) ++e;
    if (e < testEyes.size()) {
      hint = e;
      continue;
    }
    ++batch.loss.lost;
    batch.lost.push_back(what);
  }
}

bool RandomLooks::sees(const glm::dvec3& eye, const Lost& what, RayCounts& rays) const {
  return what.surface.sideOf(eye) == Side::met &&
         nothingBefore(scene_, eye, what.surface.point(), what.tolerance, rays);
}

}  // namespace acentric
