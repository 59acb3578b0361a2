#include "engine/cli/path_frames.h"

#include <fmt/format.h>

namespace acentric::cli {
namespace {

Result<std::vector<PerspectiveView>> viewsAlong(const CameraPath& path, const OpenProject& open,
                                                PictureSize size, double fovDegrees) {
  std::vector<PerspectiveView> views;
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    const PathPose& pose = path.poses[i];
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
                           const std::string& size, double fovDegrees, int tourFrames, const Common& common) {
  const auto pictureSize = parseSize(size);
  if (!pictureSize) return tl::unexpected(pictureSize.error());
  auto open = openProject(project, common.host, common.progress, common.stop);
  if (!open) return tl::unexpected(open.error());
  const auto path = pathFile.empty()
                        ? Result<CameraPath>(tourOf(*open->layout, open->project.spawn.position, tourFrames))
                        : loadPath(pathFile);
  if (!path) return tl::unexpected(path.error());
  auto views = viewsAlong(*path, *open, *pictureSize, fovDegrees);
  if (!views) return tl::unexpected(views.error());
  return PathWalk{std::move(*open), *pictureSize, std::move(*views)};
}

}  // namespace acentric::cli
