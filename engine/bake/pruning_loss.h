#pragma once
/// What pruning loses: surfaces that an eye of a region sees and none of its test eyes does.

#include <cstdint>

#include "engine/bake/bake_settings.h"
#include "engine/bake/ray_scene.h"
#include "engine/layout/layout.h"

namespace acentric {

/// Looks of eyes chosen at random, one direction each, and how many of them lose what they see.
struct PruningLoss {
  std::uint64_t looks = 0, lost = 0;

  double share() const { return looks > 0 ? double(lost) / double(looks) : 0; }
  /// With 95 % confidence the share of all looks is no larger: the exact one-sided limit of Clopper and
  /// Pearson (1934). 1 where nobody looked.
  double atMost() const;
  PruningLoss& operator+=(const PruningLoss& other);
};

/// Eyes uniform in the region and within the settings' eye range of `eyeZ`; directions uniform all round,
/// within 45 degrees of level. A look loses the nearest opaque surface where a bake keeps it only if a test
/// eye sees it, and none does, by the bake's tolerance and by rays alone. Looks into the background, and at
/// what lies within the region's near band, which is drawn as polygons, lose nothing. The same seed makes the
/// same looks whatever the number of test eyes is.
PruningLoss pruningLoss(const RayScene& scene, const Region& region, double eyeZ,
                        const BakeSettings& settings, int looks, std::uint64_t seed);

}  // namespace acentric
