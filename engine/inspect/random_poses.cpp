#include "engine/inspect/random_poses.h"

#include <fmt/format.h>

#include <random>

namespace acentric {
namespace {

constexpr int kTriesPerPose = 10000;

/// Standard distributions differ between libraries; this does not.
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : engine_(seed) {}
  double in(double low, double high) { return low + double(engine_() >> 11) * 0x1p-53 * (high - low); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace

Status RandomPoseOptions::check() const {
  if (count < 1 || count > 100000)
    return fail(ErrorKind::invalidArgument, fmt::format("{} poses: must be 1 to 100000", count),
                "random poses");
  if (!(mostPitch >= 0 && mostPitch <= kPi / 2))
    return fail(ErrorKind::invalidArgument, "the pitch must lie within 0 and 90 degrees", "random poses");
  return {};
}

Result<std::vector<RandomPose>> randomPoses(const StandingArea& area, const RandomPoseOptions& options) {
  if (Status sound = options.check(); !sound) return tl::unexpected(sound.error());
  const auto nowhere = [] {
    return fail(ErrorKind::invalidArgument, "there is no walkable outline to stand in: draw one",
                "random poses");
  };
  if (area.empty()) return nowhere();
  Uniform random(options.seed);
  std::vector<RandomPose> poses;
  for (int tries = 0; int(poses.size()) < options.count; ++tries) {
    if (tries == kTriesPerPose) return nowhere();
    const double x = random.in(area.low.x, area.high.x), y = random.in(area.low.y, area.high.y);
    if (!area.contains({x, y})) continue;
    const double yaw = random.in(0, kTwoPi), pitch = random.in(-options.mostPitch, options.mostPitch);
    poses.push_back({{x, y}, yaw, pitch});
    tries = 0;
  }
  return poses;
}

}  // namespace acentric
