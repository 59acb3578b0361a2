#include "engine/cli/path_frames.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/geometry/conventions.h"

namespace acentric::cli {
namespace {

Result<std::vector<PerspectiveView>> viewsAlong(const CameraPath& path, std::span<const OpenProject> storeys,
                                                PictureSize size, double fovDegrees) {
  std::vector<PerspectiveView> views;
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    const PathPose& pose = path.poses[i];
    const OpenProject& open = storeys[storeyAt(storeys, pose.eye)];
    const PerspectiveView view =
        viewAt(pose, fovDegrees > 0 ? fovDegrees : open.project.fovDegrees, {size.width, size.height});
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

PerspectiveView between(const PerspectiveView& from, const PerspectiveView& to, double share) {
  PerspectiveView view = from;
  view.eye = glm::mix(from.eye, to.eye, share);
  view.yawRadians += share * std::remainder(to.yawRadians - from.yawRadians, kTwoPi);
  view.pitchRadians = glm::mix(from.pitchRadians, to.pitchRadians, share);
  return view;
}

std::vector<PerspectiveView> spreadAlong(const PathWalk& walk, int count) {
  if (std::size_t(count) <= walk.views.size()) return evenly(walk.views, count);
  std::vector<PerspectiveView> views;
  for (int i = 0; i < count; ++i) {
    const double at = double(i) * double(walk.views.size() - 1) / double(count - 1);
    const std::size_t from = std::min(std::size_t(at), walk.views.size() - 1);
    PerspectiveView view =
        between(walk.views[from], walk.views[std::min(from + 1, walk.views.size() - 1)], at - double(from));
    const Layout& layout = *walk.storeys[storeyAt(walk.storeys, view.eye)].layout;
    view.eye = clampToLayout(layout, view.eye);  // a path may cut corners
    views.push_back(view);
  }
  return views;
}

}  // namespace acentric::cli
