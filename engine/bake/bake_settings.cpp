#include "engine/bake/bake_settings.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace acentric {

Status BakeSettings::check() const {
  const auto inRange = [](double value, double low, double high) {
    return std::isfinite(value) && value >= low && value <= high;
  };
  const auto bad = [](std::string message) {
    return fail(ErrorKind::invalidArgument, std::move(message), "bake settings");
  };
  if (!inRange(samplesPerDegree, 0.5, 64))
    return bad(fmt::format("{} samples per degree: must lie in 0.5..64", samplesPerDegree));
  if (ambientRays < 0 || ambientRays > 1024)
    return bad(fmt::format("{} ambient rays: must lie in 0..1024", ambientRays));
  if (shadowRays < 1 || shadowRays > 1024)
    return bad(fmt::format("{} shadow rays: must lie in 1..1024", shadowRays));
  if (bounces < 1 || bounces > 8) return bad(fmt::format("{} bounces: must lie in 1..8", bounces));
  for (const auto& [what, metres] :
       {std::pair{"ambient radius", ambientRadius}, std::pair{"surface texel", surfaceTexel}})
    if (!inRange(metres, kLeastBakeLength, kLargestBakeLength))
      return bad(
          fmt::format("{} {} m: must lie in {}..{:.0f}", what, metres, kLeastBakeLength, kLargestBakeLength));
  if (testEyes < 1 || testEyes > 64) return bad(fmt::format("{} test eyes: must lie in 1..64", testEyes));
  if (!inRange(eyeRange, 0, kLargestBakeLength))
    return bad(fmt::format("eye range {} m: must lie in 0..{:.0f}", eyeRange, kLargestBakeLength));
  if (maxLayers < 1 || maxLayers > 64) return bad(fmt::format("{} layers: must lie in 1..64", maxLayers));
  return {};
}

void BakeSettings::addTo(Hasher& hasher) const {
  hasher.value(samplesPerDegree)
      .value(ambientRays)
      .value(ambientRadius)
      .value(surfaceTexel)
      .value(maxLayers)
      .value(shadowRays)
      .value(bounces);
  hasher.value(int(pruning)).value(testEyes).value(eyeRange);
}

}  // namespace acentric
