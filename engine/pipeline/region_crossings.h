#pragma once
/// Where a walk changes region: there the same eye is served by other images, and the picture may jump.

#include <vector>

#include "engine/pipeline/camera_path.h"

namespace acentric {

struct RegionCrossing {
  PathPose before, after;  ///< in either region, less than a micrometre apart
  int from = 0, to = 0;    ///< regions
  double share = 0;        ///< of the step that lies before it
};

/// The straight step from one pose to the next, turning the shorter way round. Empty where the step begins
/// outside all regions; where it leaves them the crossings end.
std::vector<RegionCrossing> crossingsBetween(const Layout& layout, const PathPose& a, const PathPose& b);

}  // namespace acentric
