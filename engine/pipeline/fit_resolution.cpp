#include "engine/pipeline/fit_resolution.h"

#include <algorithm>
#include <cmath>

#include "engine/bake/bake_settings.h"

namespace acentric {
namespace {

constexpr int kWholeTries = 3;
/// The part is baked twice if the first guess was off by so much.
constexpr double kGoodGuess = 1.5;

double better(double samplesPerDegree, double bytes, double target) {
  return std::clamp(samplesPerDegree * std::sqrt(target / bytes), kLeastSamplesPerDegree,
                    kMostSamplesPerDegree);
}

}  // namespace

Result<double> fitResolution(double first, double target, double tolerance,
                             const std::function<Result<double>(double)>& rough,
                             const std::function<Result<double>(double)>& whole) {
  double at = first;
  for (int n = 0; n < 2; ++n) {
    const auto bytes = rough(at);
    if (!bytes) return bytes;
    const double next = better(at, std::max(*bytes, 1.0), target);
    const bool good = std::max(next / at, at / next) < kGoodGuess;
    at = next;
    if (good) break;
  }
  for (int n = 0;; ++n) {
    const auto bytes = whole(at);
    if (!bytes) return bytes;
    const double next = better(at, std::max(*bytes, 1.0), target);
    if (std::abs(*bytes / target - 1) <= tolerance || n + 1 == kWholeTries || next == at) return at;
    at = next;
  }
}

}  // namespace acentric
