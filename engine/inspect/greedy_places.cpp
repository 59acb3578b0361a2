#include "engine/inspect/greedy_places.h"

#include <algorithm>

namespace acentric {

Sights sightsOf(const std::vector<glm::dvec3>& eyes, const std::vector<glm::dvec3>& points,
                const OpaqueTracer& tracer, TaskRunner& runner) {
  Sights sights(eyes.size());
  runner.parallelFor(eyes.size(), [&](std::size_t i) {
    sights[i].reserve(points.size());
    for (const glm::dvec3& point : points) sights[i].push_back(hidden(tracer, eyes[i], point) ? 0 : 1);
  });
  return sights;
}

std::vector<std::size_t> chooseGreedily(const Sights& sights, std::size_t count) {
  std::vector<std::size_t> chosen;
  if (sights.empty()) return chosen;
  std::vector<int> times(sights.front().size(), 0);  // that chosen places see each point
  std::vector<char> taken(sights.size(), 0);
  count = std::min(count, sights.size());
  const auto gain = [&](std::size_t place, int most) {
    std::size_t points = 0;
    for (std::size_t p = 0; p < times.size(); ++p) points += sights[place][p] != 0 && times[p] <= most;
    return points;
  };
  for (int most = 0; chosen.size() < count;) {
    std::size_t best = sights.size(), bestGain = 0;
    for (std::size_t place = 0; place < sights.size(); ++place) {
      if (taken[place] != 0) continue;
      const std::size_t own = gain(place, most);
      if (own > bestGain) best = place, bestGain = own;
    }
    if (best == sights.size()) {
      if (most > int(chosen.size())) break;  // what is left sees nothing at all
      ++most;
      continue;
    }
    taken[best] = 1;
    chosen.push_back(best);
    for (std::size_t p = 0; p < times.size(); ++p) times[p] += sights[best][p];
  }
  return chosen;
}

Result<std::vector<glm::dvec2>> greedyPlaces(const StandingArea& area, double eyeZ, const ScenePtr& scene,
                                             const OpaqueTracer& tracer, std::size_t count,
                                             const std::vector<glm::dvec2>& others, TaskRunner& runner,
                                             const GreedyOptions& options) {
  RandomPoseOptions random;
  random.count = options.eyes, random.seed = options.seed;
  const auto poses = randomPoses(area, random);
  if (!poses) return tl::unexpected(poses.error());
  std::vector<glm::dvec3> eyes, points, seen, candidates;
  for (const RandomPose& pose : *poses) eyes.emplace_back(pose.place, eyeZ);
  const SurfacePoints surface(scene);
  if (!(surface.area() > 0))
    return fail(ErrorKind::invalidArgument, "the scene has no surface to be seen", "greedy places");
  for (int n = 0; n < options.points; ++n) points.push_back(surface.at(std::uint64_t(n)).position);
  const Sights fromEyes = sightsOf(eyes, points, tracer, runner);
  for (std::size_t p = 0; p < points.size(); ++p)
    if (std::ranges::any_of(fromEyes, [p](const std::vector<char>& sight) { return sight[p] != 0; }))
      seen.push_back(points[p]);
  std::vector<glm::dvec2> places = gridIn(area, options.candidates);
  places.insert(places.end(), others.begin(), others.end());
  for (const glm::dvec2& place : places) candidates.emplace_back(place, eyeZ);
  std::vector<glm::dvec2> chosen;
  for (const std::size_t place : chooseGreedily(sightsOf(candidates, seen, tracer, runner), count))
    chosen.push_back(places[place]);
  if (chosen.empty())
    return fail(ErrorKind::invalidArgument, "no surface is seen from the walkable area", "greedy places");
  return chosen;
}

}  // namespace acentric
