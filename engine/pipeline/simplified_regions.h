#pragma once
/// Simplified local geometry of regions above the project's triangle budget: made once, kept in the capture
/// store under a content key, taken from there at every later opening.

#include <optional>
#include <stop_token>

#include "engine/pipeline/pipeline.h"
#include "engine/scene/simplify.h"

namespace acentric {

/// Of one region's simplified geometry: everything that can change it.
ContentKey simplifiedKey(const OpenProject& open, const Region& region);
/// Of all regions, for pruning: what is in the store under other keys is no longer used. None when the
/// project does not simplify.
std::vector<ContentKey> simplifiedKeys(const OpenProject& open);

struct SimplifiedRegion {
  std::shared_ptr<const LocalGeometry> geometry;
  SimplifyReport report;
  bool fromStore = false;
  std::optional<Error> notKept;  ///< why it is not in the store, or why what was there was not used
};

/// `full` is region `region` clipped from the scene (null: clipped where it is needed); `light` may be null
/// (not baked). Where the result is new, its cost in pictures is measured too. Runs on one thread.
Result<SimplifiedRegion> simplifiedRegion(const OpenProject& open, int region,
                                          const std::shared_ptr<const LocalGeometry>& full,
                                          const std::shared_ptr<const SurfaceLight>& light,
                                          const CaptureStore& store, std::stop_token stop);

/// Pictures of the region's local geometry alone from a few eyes in it, full and simplified: fills the
/// report's comparedFrames, psnr and meanDifference.
void measureCost(const OpenProject& open, int region, const std::shared_ptr<const LocalGeometry>& full,
                 const std::shared_ptr<const LocalGeometry>& simplified,
                 const std::shared_ptr<const SurfaceLight>& light, SimplifyReport& report);

}  // namespace acentric
