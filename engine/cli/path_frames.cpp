#include "engine/cli/path_frames.h"

#include <fmt/format.h>

namespace acentric::cli {
namespace {

Result<std::vector<PerspectiveView>> viewsAlong(const CameraPath& path, std::span<const OpenProject> storeys,
                                                PictureSize size, double fovDegrees) {
  std::vector<PerspectiveView> views;
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    const PathPose& pose = path.poses[i];
    const OpenProject& open = storeys[storeyAt(storeys, pose.eye)];
    PerspectiveView view;
    view.eye = pose.eye;
    view.yawRadians = pose.yawRadians;
    view.pitchRadians = pose.pitchRadians;
    view.fovRadians = radians(fovDegrees > 0 ? fovDegrees : open.project.fovDegrees);
    view.width = size.width;
    view.height = size.height;
    if (Status sound = view.check(); !sound)
      return fail(sound.error().kind, sound.error().message, fmt::format("/frames/{}", i));
    if (!open.layout->regionAt(glm::dvec2(pose.eye))) {
      const glm::dvec2 near = clampToPlan(*open.layout, glm::dvec2(pose.eye));
      return fail(ErrorKind::invalidArgument,
                  fmt::format("the eye ({:.2f}, {:.2f}) stands outside every region; the nearest place "
                              "inside is ({:.2f}, {:.2f})",
                              pose.eye.x, pose.eye.y, near.x, near.y),
                  fmt::format("/frames/{}", i));
    }
    views.push_back(view);
  }
  return views;
}

}  // namespace

Result<PathWalk> openAlong(const std::filesystem::path& project, const std::filesystem::path& pathFile,
                           const std::string& size, double fovDegrees, int tourFrames, const Common& common,
                           Along along) {
  const auto pictureSize = parseSize(size);
  if (!pictureSize) return tl::unexpected(pictureSize.error());
  auto current = openChosen(project, common);
  if (!current) return tl::unexpected(current.error());
  const auto path =
      pathFile.empty()
          ? Result<CameraPath>(tourOf(*current->layout, current->project.spawn().position, tourFrames))
          : loadPath(pathFile);
  if (!path) return tl::unexpected(path.error());
  PathWalk walk{{}, *pictureSize, {}};
  if (pathFile.empty() || along == Along::oneStorey || !common.storey.empty()) {
    walk.storeys.push_back(std::move(*current));
  } else {
    auto storeys = acentric::openStoreys(*current, common.host, common.progress, common.stop);
    if (!storeys) return tl::unexpected(storeys.error());
    walk.storeys = std::move(*storeys);
  }
  auto views = viewsAlong(*path, walk.storeys, *pictureSize, fovDegrees);
  if (!views) return tl::unexpected(views.error());
  walk.views = std::move(*views);
  return walk;
}

}  // namespace acentric::cli
