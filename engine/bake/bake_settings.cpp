#include "engine/bake/bake_settings.h"

#include <fmt/format.h>

#include <cmath>

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
  if (!inRange(ambientRadius, 1e-3, 1e5))
    return bad(fmt::format("ambient radius {} m: must lie in 0.001..100000", ambientRadius));
  if (!inRange(surfaceTexel, 0.002, 10))
    return bad(fmt::format("surface texel {} m: must lie in 0.002..10", surfaceTexel));
  if (maxLayers < 1 || maxLayers > 64) return bad(fmt::format("{} layers: must lie in 1..64", maxLayers));
  return {};
}

void BakeSettings::addTo(Hasher& hasher) const {
  hasher.value(samplesPerDegree).value(ambientRays).value(ambientRadius).value(surfaceTexel).value(maxLayers);
}

}  // namespace acentric
