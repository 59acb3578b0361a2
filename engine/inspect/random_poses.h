#pragma once
/// Eyes at random: what is measured from them is measured of the whole area, not of a path that suits
/// somebody. The same seed gives the same poses on every machine.

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "engine/base/result.h"
#include "engine/geometry/conventions.h"
#include "engine/inspect/standing_area.h"

namespace acentric {

struct RandomPoseOptions {
  int count = 500;                   ///< 1..100000
  double mostPitch = radians(20.0);  ///< radians up and down, 0..pi/2
  std::uint64_t seed = 1;
  Status check() const;
};

struct RandomPose {
  glm::dvec2 place{0};  ///< plan, metres
  double yawRadians = 0, pitchRadians = 0;
};

/// Places uniform in the area, yaw uniform all round, pitch uniform within its limits. Fails where the area
/// is empty, or so small a share of its box that it is not found.
Result<std::vector<RandomPose>> randomPoses(const StandingArea& area, const RandomPoseOptions& options);

}  // namespace acentric
