#include "engine/cli/path_frames.h"

#include <fmt/format.h>

namespace acentric::cli {

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

Result<CameraPath> pathOrTour(const std::filesystem::path& file, const OpenProject& open, int tourFrames) {
  if (!file.empty()) return loadPath(file);
  return tourOf(*open.layout, open.project.spawn.position, tourFrames);
}

}  // namespace acentric::cli
