#pragma once
/// Recorded poses, many a second, as few key poses.

#include "engine/pipeline/camera_path.h"

namespace acentric {

/// How far what is kept may be from what was recorded, at any recorded moment.
struct PathTolerance {
  double metres = 0.01;
  double turnRadians = 0.5 * kPi / 180;  ///< of yaw and of pitch
};

/// The first pose, the last, and of those between as many as the tolerance asks for (Douglas and Peucker's
/// way, at equal times). Where they would be more than `most` (at least 2), the tolerance grows.
CameraPath thinned(const CameraPath& path, PathTolerance tolerance = {}, std::size_t most = 10000);

}  // namespace acentric
