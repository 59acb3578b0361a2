#pragma once
/// A walk as data: JSON {"version":1,"frames":[{"eye":[x,y,z],"yaw":deg,"pitch":deg}, ...]} in metres and
/// degrees. Either each pose is a frame, or each has its time, "seconds" that ascend from 0: then poses are
/// key poses, and between them the eye moves and turns evenly, the shorter way round.

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
  double seconds = 0;  ///< since the path began; 0 in a path without times

  /// Numbers in range.
  Status check() const;
  bool operator==(const PathPose&) const = default;
};

inline constexpr double kMostPathSeconds = 6 * 3600;
/// Frames per second at which a path with times is played into pictures.
inline constexpr int kPathRate = 30;

/// `fovDegrees` is horizontal.
PerspectiveView viewAt(const PathPose& pose, double fovDegrees, glm::ivec2 pixels);

struct CameraPath {
  std::vector<PathPose> poses;  ///< at least one

  /// With several poses, are they key poses with times?
  bool timed() const { return seconds() > 0; }
  double seconds() const { return poses.empty() ? 0 : poses.back().seconds; }
  /// Finite places and angles, and times that ascend from 0 if there are any; names the pose as "/3".
  Status check() const;
  bool operator==(const CameraPath&) const = default;
};

/// Where the eye of a path with times is; before its beginning and after its end, there.
PathPose poseAt(const CameraPath& path, double seconds);
/// A share (0..1) of the way from one pose to the next, in time too.
PathPose between(const PathPose& from, const PathPose& to, double share);
/// A pose per frame, kPathRate a second, last one included; without times. A path without times as it is.
CameraPath framesOf(const CameraPath& path);

/// Also of nerfstudio's transforms.json and COLMAP's images.txt (foreign_paths.h).
Result<CameraPath> loadPath(const std::filesystem::path& path);
Status savePath(const CameraPath& path, const std::filesystem::path& file);

/// A tour through the placed regions: visits region centres nearest first from `start`, turning to where the
/// view is longest, `frames` poses.
CameraPath tourOf(const Layout& layout, const glm::dvec2& start, int frames);

/// The point itself if a placed region holds it, else the nearest point just inside one.
glm::dvec2 clampToPlan(const Layout& layout, const glm::dvec2& point);

}  // namespace acentric
