#pragma once
/// A walk as data: JSON {"version":1,"frames":[{"eye":[x,y,z],"yaw":deg,"pitch":deg}, ...]} in metres and
/// degrees.

#include <filesystem>
#include <vector>

#include "engine/base/result.h"
#include "engine/geometry/perspective_view.h"
#include "engine/layout/layout.h"

namespace acentric {

struct PathPose {
  glm::dvec3 eye{0};
  double yawRadians = 0;
  double pitchRadians = 0;
};

/// `fovDegrees` is horizontal.
PerspectiveView viewAt(const PathPose& pose, double fovDegrees, glm::ivec2 pixels);

struct CameraPath {
  std::vector<PathPose> poses;
};

Result<CameraPath> loadPath(const std::filesystem::path& path);
Status savePath(const CameraPath& path, const std::filesystem::path& file);

/// A tour through the placed regions: visits region centres nearest first from `start`, turning to where the
/// view is longest, `frames` poses.
CameraPath tourOf(const Layout& layout, const glm::dvec2& start, int frames);

/// The point itself if a placed region holds it, else the nearest point just inside one.
glm::dvec2 clampToPlan(const Layout& layout, const glm::dvec2& point);

}  // namespace acentric
