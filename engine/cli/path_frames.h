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
  std::vector<OpenProject> storeys;
  PictureSize size;
  std::vector<PerspectiveView> views;  ///< one per frame
};

/// A path may lead through all storeys, unless one was chosen or only one can be dealt with.
enum class Along { anyStorey, oneStorey };

/// `path`: one of the project's by its name, or a file; empty = a tour of `tourFrames` through all regions of
/// one storey. One with times is played at kPathRate. `fovDegrees` 0 = the project's. Fails, naming the
/// frame, when an eye stands outside every region.
Result<PathWalk> openAlong(const std::filesystem::path& project, const std::filesystem::path& path,
                           const std::string& size, double fovDegrees, int tourFrames, const Common& common,
                           Along along = Along::anyStorey);

/// Views along a path, as above, of one storey's project.
Result<std::vector<PerspectiveView>> viewsOn(const OpenProject& open, const std::filesystem::path& path,
                                             PictureSize size, double fovDegrees);

/// A share of the way from one view to another, turning the shorter way round.
PerspectiveView between(const PerspectiveView& from, const PerspectiveView& to, double share);

/// `count` views along the walk, evenly chosen; in between by interpolation where the path has fewer.
std::vector<PerspectiveView> spreadAlong(const PathWalk& walk, int count);

/// `count` entries, evenly chosen, first and last included.
template <class T>
std::vector<T> evenly(const std::vector<T>& all, int count) {
  if (count <= 0 || std::size_t(count) >= all.size()) return all;
  std::vector<T> chosen;
  for (int i = 0; i < count; ++i)
    chosen.push_back(all[std::size_t(i) * (all.size() - 1) / std::size_t(std::max(count - 1, 1))]);
  return chosen;
}

}  // namespace acentric::cli
