#include "engine/bake/bake_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace acentric {
namespace {}  // namespace

const char* nameOf(Quality quality) {
  return quality == Quality::preview ? "preview" : quality == Quality::draft ? "draft" : "final";
}

BakeSettings BakeSettings::at(Quality quality) const {
  BakeSettings out = *this;
  if (quality == Quality::full) return out;
  const bool preview = quality == Quality::preview;
  const int part = preview ? 4 : 2;
  const auto fewer = [&](int& count, int least) { count = std::min(count, std::max(count / part, least)); };
  out.samplesPerDegree =
      std::max(samplesPerDegree / (preview ? 8 : 2), std::min(samplesPerDegree, kLeastSamplesPerDegree));
  fewer(out.ambientRays, 4);
  fewer(out.shadowRays, 4);
  fewer(out.bounces, 1);
  out.surfaceTexel = std::min(surfaceTexel * part, kLargestBakeLength);
  // Behind the first surface a preview shows nothing, so that it asks no eye.
  out.maxLayers = preview ? 1 : std::min(maxLayers, 4);
  out.pruning = !preview && pruning;
  fewer(out.testEyes, 4);
  out.pruningLoss = 0;
  return out;
}

Status BakeSettings::check() const {
  const auto inRange = [](double value, double low, double high) {
    return std::isfinite(value) && value >= low && value <= high;
  };
  const auto bad = [](std::string message) {
    return fail(ErrorKind::invalidArgument, std::move(message), "bake settings");
  };
  if (!inRange(samplesPerDegree, kLeastSamplesPerDegree, kMostSamplesPerDegree))
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
  if (testEyes < 1 || testEyes > kMostTestEyes)
    return bad(fmt::format("{} test eyes: must lie in 1..{}", testEyes, kMostTestEyes));
  if (pruningLoss != 0 && !inRange(pruningLoss, kLeastPruningLoss, 1))
    return bad(fmt::format("pruning may lose {} of what is seen: must be 0 or lie in {}..1", pruningLoss,
                           kLeastPruningLoss));
  if (!inRange(eyeRange, 0, kLargestBakeLength))
    return bad(fmt::format("eye range {} m: must lie in 0..{:.0f}", eyeRange, kLargestBakeLength));
  if (!inRange(distanceShift, 0, kLargestDistanceShift))
    return bad(fmt::format("distances that shift pictures by {} samples: must lie in 0..{}", distanceShift,
                           kLargestDistanceShift));
  if (colourQuality < 0 || colourQuality > kLosslessColours)
    return bad(fmt::format("colours of quality {}: must lie in 0..{}", colourQuality, kLosslessColours));
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
  hasher.value(int(pruning)).value(testEyes).value(pruningLoss).value(eyeRange);
  // Captures of before this could be set are as those of the usual value.
  if (distanceShift != kUsualDistanceShift) hasher.value(distanceShift);
  hasher.text("colours").value(colourQuality);
  if (silhouettes) hasher.text("silhouettes").value(kSilhouetteVersion);
}

}  // namespace acentric
