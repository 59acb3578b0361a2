#include "engine/pipeline/thin_path.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace acentric {
namespace {

/// Above 1: more than the tolerance.
double deviation(const PathPose& kept, const PathPose& recorded, const PathTolerance& tolerance) {
  const double yaw = std::abs(std::remainder(kept.yawRadians - recorded.yawRadians, kTwoPi));
  const double pitch = std::abs(kept.pitchRadians - recorded.pitchRadians);
  return std::max(glm::distance(kept.eye, recorded.eye) / tolerance.metres,
                  std::max(yaw, pitch) / tolerance.turnRadians);
}

/// Of the poses between `first` and `last` the one that lies farthest off, if it is off by too much; else
/// `first`.
std::size_t farthest(const std::vector<PathPose>& poses, std::size_t first, std::size_t last,
                     const PathTolerance& tolerance) {
  const PathPose &from = poses[first], &to = poses[last];
  std::size_t worst = first;
  double most = 1;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double share = (poses[i].seconds - from.seconds) / (to.seconds - from.seconds);
    const double off = deviation(between(from, to, share), poses[i], tolerance);
    if (off > most) most = off, worst = i;
  }
  return worst;
}

CameraPath thinnedOnce(const CameraPath& path, const PathTolerance& tolerance) {
  std::vector<bool> kept(path.poses.size(), false);
  kept.front() = kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> spans{{0, path.poses.size() - 1}};
  while (!spans.empty()) {
    const auto [first, last] = spans.back();
    spans.pop_back();
    const std::size_t middle = farthest(path.poses, first, last, tolerance);
    if (middle == first) continue;
    kept[middle] = true;
    spans.emplace_back(first, middle);
    spans.emplace_back(middle, last);
  }
  CameraPath thin;
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i]) thin.poses.push_back(path.poses[i]);
  return thin;
}

}  // namespace

CameraPath thinned(const CameraPath& path, PathTolerance tolerance, std::size_t most) {
  if (path.poses.size() < 3 || !path.timed()) return path;
  for (;;) {
    CameraPath thin = thinnedOnce(path, tolerance);
    if (thin.poses.size() <= most) return thin;
    tolerance.metres *= 2;
    tolerance.turnRadians *= 2;
  }
}

}  // namespace acentric
