#pragma once
/// Views along a camera path, shared by walk, measure and bench.

#include <vector>

#include "engine/cli/command.h"
#include "engine/cli/commands.h"
#include "engine/geometry/perspective_view.h"
#include "engine/pipeline/camera_path.h"

namespace acentric::cli {

/// A project opened for a walk along a path.
struct PathWalk {
  OpenProject open;
  PictureSize size;
  std::vector<PerspectiveView> views;  ///< one per pose
};

/// `pathFile` empty = a tour of `tourFrames` through all regions; `fovDegrees` 0 = the project's. Fails,
/// naming the frame, when an eye stands outside every region.
Result<PathWalk> openAlong(const std::filesystem::path& project, const std::filesystem::path& pathFile,
                           const std::string& size, double fovDegrees, int tourFrames, const Common& common);

}  // namespace acentric::cli
