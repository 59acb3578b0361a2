#include "engine/bake/test_eyes.h"

#include <algorithm>
#include <cmath>

#include "engine/base/hash.h"

namespace acentric {
namespace {

/// Looks of a round times the share that may be lost: a limit of that share then allows six lost looks, about
/// half of it.
constexpr double kLooksTimesLoss = 12;
/// Of what may be lost, what eyes are added for in one round: the next takes fresh looks.
constexpr double kRest = 0.25;
/// Lost looks that a round chooses by, and eyes that it chooses among.
constexpr std::size_t kMostLost = 512, kMostCandidates = 64;

/// Eyes of neighbouring regions at one corner differ by rounding; this makes them the same.
glm::dvec3 snapped(const glm::dvec2& place, double z, double scale) {
  const double step = std::ldexp(1.0, std::ilogb(scale) - 20);
  const auto snap = [&](double value) { return std::nearbyint(value / step) * step; };
  return {snap(place.x), snap(place.y), z};
}

/// -1, 0 or 1, by the place alone.
int heightOf(const glm::dvec3& place) {
  Hasher hasher;
  hasher.value(place.x + 0.0).value(place.y + 0.0);  // -0 as 0
  return int(hasher.finish().low % 3) - 1;
}

template <class T>
std::vector<T> everyNth(const std::vector<T>& all, std::size_t atMost) {
  std::vector<T> some;
  const std::size_t count = std::min(all.size(), atMost);
  for (std::size_t i = 0; i < count; ++i) some.push_back(all[i * all.size() / count]);
  return some;
}

/// Adds those of the eyes that lost something which, one after the other, see most of what is left.
void addEyes(const RandomLooks& looks, const std::vector<RandomLooks::Lost>& lost, double mayBeLost,
             std::vector<glm::dvec3>& eyes, TaskRunner& runner, RayCounts& rays) {
  const std::vector<RandomLooks::Lost> wanted = everyNth(lost, kMostLost);
  const std::vector<RandomLooks::Lost> candidates = everyNth(wanted, kMostCandidates);
  std::vector<std::vector<bool>> sees(candidates.size(), std::vector<bool>(wanted.size()));
  std::vector<RayCounts> counts(candidates.size());
  runner.parallelFor(candidates.size(), [&](std::size_t c) {
    for (std::size_t w = 0; w < wanted.size(); ++w)
      sees[c][w] = looks.sees(candidates[c].eye, wanted[w], counts[c]);
  });
  for (const RayCounts& count : counts) rays += count;
  std::vector<bool> seen(wanted.size());
  std::size_t left = wanted.size();
  const double enough = mayBeLost * double(wanted.size()) / double(lost.size());
  while (double(left) > enough && int(eyes.size()) < kMostTestEyes) {
    std::size_t best = 0, most = 0;
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      std::size_t more = 0;
      for (std::size_t w = 0; w < wanted.size(); ++w) more += sees[c][w] && !seen[w] ? 1 : 0;
      if (more > most) best = c, most = more;
    }
    if (most == 0) return;
    for (std::size_t w = 0; w < wanted.size(); ++w) seen[w] = seen[w] || sees[best][w];
    left -= most;
    eyes.push_back(candidates[best].eye);
  }
}

}  // namespace

std::vector<glm::dvec3> placedEyes(const ConvexPolygon& polygon, double eyeZ, const BakeSettings& settings) {
  std::vector<glm::dvec3> eyes;
  const std::size_t n = polygon.size(), wanted = std::size_t(settings.testEyes);
  if (n < 3) return eyes;
  const double scale = glm::distance(polygon.corners[0], polygon.corners[1]);
  const auto add = [&](const glm::dvec2& place) {
    if (eyes.size() >= wanted) return;
    glm::dvec3 eye = snapped(place, eyeZ, scale);
    eye.z += settings.eyeRange * heightOf(eye);
    eyes.push_back(eye);
  };
  const std::size_t corners = std::min(n, wanted);
  for (std::size_t i = 0; i < corners; ++i) add(polygon.corners[i * n / corners]);
  const glm::dvec2 centre = polygon.centroid();
  add(centre);
  for (std::size_t i = 0; i < n; ++i) add(0.5 * (polygon.corners[i] + polygon.corners[(i + 1) % n]));
  // Inside: a triangle of the fan around the centre by turns, and in it the additive recurrence of the
  // plastic number, which spreads evenly however many follow.
  constexpr double kPlastic = 1.32471795724474602596;
  for (std::size_t i = 0; eyes.size() < wanted; ++i) {
    double a = std::fmod(0.5 + double(i + 1) / kPlastic, 1),
           b = std::fmod(0.5 + double(i + 1) / (kPlastic * kPlastic), 1);
    if (a + b > 1) a = 1 - a, b = 1 - b;
    add(centre + a * (polygon.corners[i % n] - centre) + b * (polygon.corners[(i + 1) % n] - centre));
  }
  return eyes;
}

RegionEyes findTestEyes(const RayScene& scene, const ConvexPolygon& polygon, const ConvexPolygon& grown,
                        double eyeZ, const BakeSettings& settings, TaskRunner& runner, RayCounts& rays,
                        const std::stop_token& stop) {
  RegionEyes found;
  found.eyes = placedEyes(polygon, eyeZ, settings);
  found.placed = found.eyes.size();
  if (found.eyes.empty() || !(settings.pruningLoss > 0)) return found;
  const RandomLooks random(scene, polygon, grown, eyeZ, settings);
  const double looks = std::ceil(kLooksTimesLoss / settings.pruningLoss);
  for (std::uint64_t round = 0; !stop.stop_requested(); ++round) {
    std::vector<RandomLooks::Lost> lost;
    found.loss = random.loss(found.eyes, std::size_t(looks), round, runner, rays, &lost, stop);
    if (found.loss.atMost() <= settings.pruningLoss || int(found.eyes.size()) >= kMostTestEyes) break;
    const std::size_t before = found.eyes.size();
    addEyes(random, lost, kRest * settings.pruningLoss * looks, found.eyes, runner, rays);
    if (found.eyes.size() == before) break;
  }
  return found;
}

std::shared_ptr<const RegionEyes> TestEyes::of(const ConvexPolygon& polygon, const ConvexPolygon& grown,
                                               double eyeZ, TaskRunner& runner, RayCounts& rays,
                                               const std::stop_token& stop) {
  std::vector<double> key{eyeZ};
  for (const ConvexPolygon* of : {&polygon, &grown})
    for (const glm::dvec2& corner : of->corners) key.insert(key.end(), {corner.x, corner.y});
  {
    const std::lock_guard lock(mutex_);
    if (const auto known = found_.find(key); known != found_.end()) return known->second;
  }
  auto eyes = std::make_shared<const RegionEyes>(
      findTestEyes(scene_, polygon, grown, eyeZ, settings_, runner, rays, stop));
  if (stop.stop_requested()) return nullptr;
  const std::lock_guard lock(mutex_);
  return found_.try_emplace(std::move(key), std::move(eyes)).first->second;
}

TestEyeSummary TestEyes::summary() const {
  const std::lock_guard lock(mutex_);
  TestEyeSummary all;
  for (const auto& [key, region] : found_) all.add(*region);
  return all;
}

void TestEyeSummary::add(const RegionEyes& region) {
  ++regions;
  eyes += region.eyes.size();
  most = std::max(most, region.eyes.size());
  loss += region.loss;
  if (region.loss.looks > 0) worstLimit = std::max(worstLimit, region.loss.atMost());
}

TestEyeSummary& TestEyeSummary::operator+=(const TestEyeSummary& other) {
  regions += other.regions;
  eyes += other.eyes;
  most = std::max(most, other.most);
  loss += other.loss;
  worstLimit = std::max(worstLimit, other.worstLimit);
  return *this;
}

}  // namespace acentric
