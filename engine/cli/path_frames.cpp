#include "engine/cli/path_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/geometry/conventions.h"
#include "engine/pipeline/walk_ground.h"

namespace acentric::cli {
namespace {

/// Metres by which a pose on the border may be written outside.
constexpr double kRounding = 1e-5;

/// Does every pose stand in a region?
Status checkStanding(const CameraPath& path, std::span<const OpenProject> storeys) {
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    const glm::dvec3& eye = path.poses[i].eye;
    const Layout& layout = *storeys[storeyAt(storeys, eye)].layout;
    if (glm::distance(clampToPlan(layout, glm::dvec2(eye)), glm::dvec2(eye)) <= kRounding) continue;
    const glm::dvec2 near = nearestStandingCentimetre(layout, glm::dvec2(eye));
    return fail(
        ErrorKind::invalidArgument,
        fmt::format("the eye ({:.2f}, {:.2f}) stands outside every region; the nearest place to stand "
                    "is ({:.2f}, {:.2f})",
                    eye.x, eye.y, near.x, near.y),
        fmt::format("/frames/{}", i));
  }
  return {};
}

Result<std::vector<PerspectiveView>> viewsAlong(const CameraPath& path, std::span<const OpenProject> storeys,
                                                PictureSize size, double fovDegrees) {
  if (Status standing = checkStanding(path, storeys); !standing) return tl::unexpected(standing.error());
  std::vector<PerspectiveView> views;
  for (const PathPose& pose : framesOf(path).poses) {
    const OpenProject& open = storeys[storeyAt(storeys, pose.eye)];
    PerspectiveView view =
        viewAt(pose, fovDegrees > 0 ? fovDegrees : open.project.fovDegrees, {size.width, size.height});
    view.eye = clampToLayout(*open.layout, view.eye);  // between key poses a path may cut corners
    if (Status sound = view.check(); !sound)
      return fail(sound.error().kind, sound.error().message, fmt::format("/frames/{}", views.size()));
    views.push_back(view);
  }
  return views;
}

/// One of the project's own by its name, else from a file.
Result<CameraPath> pathCalled(const std::filesystem::path& name, const Project& project) {
  const auto found = std::ranges::find(project.paths, name.string(), &WalkPath::name);
  if (found != project.paths.end()) return found->path;
  std::error_code error;
  if (std::filesystem::exists(name, error) || project.paths.empty()) return loadPath(name);
  std::vector<std::string> names;
  for (const WalkPath& path : project.paths) names.push_back("'" + path.name + "'");
  return fail(
      ErrorKind::notFound,
      fmt::format("is no file, and none of the project's paths; there are {}", fmt::join(names, ", ")),
      name.string());
}

}  // namespace

Result<PathWalk> openAlong(const std::filesystem::path& project, const std::filesystem::path& path,
                           const std::string& size, double fovDegrees, int tourFrames, const Common& common,
                           Along along) {
  const auto pictureSize = parseSize(size);
  if (!pictureSize) return tl::unexpected(pictureSize.error());
  auto current = openChosen(project, common);
  if (!current) return tl::unexpected(current.error());
  const auto chosen =
      path.empty()
          ? Result<CameraPath>(tourOf(*current->layout, current->project.spawn().position, tourFrames))
          : pathCalled(path, current->project);
  if (!chosen) return tl::unexpected(chosen.error());
  PathWalk walk{{}, *pictureSize, {}};
  if (path.empty() || along == Along::oneStorey || !common.storey.empty()) {
    walk.storeys.push_back(std::move(*current));
  } else {
    auto storeys = acentric::openStoreys(*current, common.host, common.progress, common.stop);
    if (!storeys) return tl::unexpected(storeys.error());
    walk.storeys = std::move(*storeys);
  }
  auto views = viewsAlong(*chosen, walk.storeys, *pictureSize, fovDegrees);
  if (!views) return tl::unexpected(views.error());
  walk.views = std::move(*views);
  return walk;
}

Result<std::vector<PerspectiveView>> viewsOn(const OpenProject& open, const std::filesystem::path& path,
                                             PictureSize size, double fovDegrees) {
  const auto chosen = pathCalled(path, open.project);
  if (!chosen) return tl::unexpected(chosen.error());
  return viewsAlong(*chosen, std::span(&open, 1), size, fovDegrees);
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
