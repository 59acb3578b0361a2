#include "engine/pipeline/start_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "engine/geometry/conventions.h"
#include "engine/geometry/round_to.h"

namespace acentric {
namespace {

constexpr double kFarthest = 40, kTooNear = 1.5;  // metres
constexpr double kRoom = 0.8;                     // metres around a person
constexpr int kYaws = 24;
constexpr std::size_t kMostPlaces = 60;

/// Free distance around an eye, at knee, hip and eye height, metres, at most `most`.
double clearance(const RayScene& rays, const glm::dvec3& eye, double eyeHeight, double most) {
  double least = most;
  for (const double drop : {0.7 * eyeHeight, 0.4 * eyeHeight, 0.0})
    for (int k = 0; k < 16; ++k) {
      const glm::dvec2 d = directionOf(kTwoPi * k / 16);
      least = std::min(
          least,
          double(rays.trace({glm::vec3(eye.x, eye.y, eye.z - drop), glm::vec3(d.x, d.y, 0)}).distance));
    }
  return least;
}

struct Candidate {
  glm::dvec2 place{0};
  double room = 0;
};

/// The middles of regions, spread evenly, of those that have room; if none has, the roomiest quarter.
std::vector<glm::dvec2> placesToStand(const Layout& layout, const RayScene& rays) {
  std::vector<glm::dvec2> middles;
  for (const Region& region : layout.regions) {
    const glm::dvec2 place = region.polygon.centroid();
    if (layout.spec.outline.empty() || layout.spec.outline.contains(place)) middles.push_back(place);
  }
  if (middles.empty())
    for (const Region& region : layout.regions) middles.push_back(region.polygon.centroid());
  const std::size_t step = middles.size() / kMostPlaces + 1;
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < middles.size(); i += step)
    candidates.push_back(
        {middles[i], clearance(rays, {middles[i], layout.eyeZ()}, layout.spec.eyeHeight, kRoom)});
  std::vector<double> rooms;
  for (const Candidate& candidate : candidates) rooms.push_back(candidate.room);
  std::ranges::sort(rooms, std::ranges::greater());
  const double enough = rooms.front() >= kRoom ? kRoom : rooms[(rooms.size() - 1) / 4];
  std::vector<glm::dvec2> places;
  for (const Candidate& candidate : candidates)
    if (candidate.room >= enough) places.push_back(candidate.place);
  return places;
}

}  // namespace

double ViewWorth::score() const {
  return std::log2(1 + depth) + 1.5 * variety - 6 * near - 3 * std::max(0.0, sky - 0.3);
}

ViewWorth worthOf(const RayScene& rays, const glm::dvec3& eye, double yawRadians) {
  constexpr int kAcross = 15, kHigh = 7;
  constexpr double kHalfWidth = 30 * kPi / 180, kHalfHeight = 17.5 * kPi / 180;
  constexpr int kManyKinds = 8;
  double logarithms = 0;
  int near = 0, sky = 0;
  std::set<std::pair<int, int>> kinds;
  for (int across = 0; across < kAcross; ++across)
    for (int high = 0; high < kHigh; ++high) {
      const double yaw = yawRadians + kHalfWidth * (2.0 * across / (kAcross - 1) - 1);
      const double pitch = kHalfHeight * (2.0 * high / (kHigh - 1) - 1);
      const glm::dvec2 flat = std::cos(pitch) * directionOf(yaw);
      const Hit hit = rays.trace({glm::vec3(eye), glm::vec3(flat.x, flat.y, std::sin(pitch))});
      const double distance = hit.found() ? double(hit.distance) : kFarthest;
      logarithms += std::log(std::clamp(distance, 1e-3, kFarthest));
      near += hit.found() && distance < kTooNear;
      sky += !hit.found();
      if (hit.found()) kinds.emplace(int(hit.mesh), rays.scene().meshOf(hit.mesh).material);
    }
  constexpr double kRays = kAcross * kHigh;
  const int more = std::clamp(int(kinds.size()) - 1, 0, kManyKinds - 1);
  return {std::exp(logarithms / kRays), near / kRays, sky / kRays, double(more) / (kManyKinds - 1)};
}

Spawn chooseStart(const Layout& layout, const RayScene& rays) {
  Spawn best;
  double most = -std::numeric_limits<double>::infinity();
  for (const glm::dvec2& place : placesToStand(layout, rays)) {
    const glm::dvec2 tidied{roundTo(place.x, 0.01), roundTo(place.y, 0.01)};
    const glm::dvec2 stand = layout.regionAt(tidied) ? tidied : place;
    for (int k = 0; k < kYaws; ++k) {
      const double yaw = kTwoPi * k / kYaws;
      const double score = worthOf(rays, {stand, layout.eyeZ()}, yaw).score();
      if (score > most) most = score, best = {stand, yaw};
    }
  }
  return best;
}

}  // namespace acentric
