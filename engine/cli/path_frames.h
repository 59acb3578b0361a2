#pragma once
/// Views along a camera path, shared by walk, measure and bench.

#include <vector>

#include "engine/cli/command.h"
#include "engine/cli/commands.h"
#include "engine/geometry/perspective_view.h"
#include "engine/pipeline/camera_path.h"

namespace acentric::cli {

/// One view per pose; `fovDegrees` 0 = the project's. Fails, naming the frame, when an eye stands outside
/// every region.
Result<std::vector<PerspectiveView>> viewsAlong(const CameraPath& path, const OpenProject& open,
                                                PictureSize size, double fovDegrees);

/// The path in a file, or a tour of so many frames through all regions where no file is named.
Result<CameraPath> pathOrTour(const std::filesystem::path& file, const OpenProject& open, int tourFrames);

}  // namespace acentric::cli
