#include "engine/cli/bundle_picture.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/stopwatch.h"
#include "engine/cli/frame_pictures.h"
#include "engine/geometry/conventions.h"

namespace acentric::cli {

namespace {

/// `bundle`: names bookmarks and where the walk begins.
Result<PerspectiveView> viewOf(const RenderOptions& options, const Bundle& bundle) {
  PerspectiveView view = startOf(bundle);
  view.fovRadians = radians(options.fovDegrees);
  if (!options.bookmark.empty()) {
    const auto found = std::ranges::find(bundle.bookmarks, options.bookmark, &BundleBookmark::name);
    if (found == bundle.bookmarks.end())
      return fail(ErrorKind::notFound, fmt::format("has no bookmark '{}'", options.bookmark),
                  options.project.string());
    view = {found->pose.eye, found->pose.yaw, found->pose.pitch, found->fov};
    return view;
  }
  if (!options.eye.empty()) {
    const auto eye = parseEye(options.eye, view.eye.z);
    if (!eye) return tl::unexpected(eye.error());
    view.eye = *eye, view.yawRadians = 0;
  }
  if (options.yawDegrees) view.yawRadians = radians(*options.yawDegrees);
  view.pitchRadians = radians(options.pitchDegrees);
  return view;
}

}  // namespace

Result<Report> renderBundle(const RenderOptions& options, const Common& common) {
  const auto size = parseSize(options.size);
  if (!size) return tl::unexpected(size.error());
  const auto needsProject = [&](const char* what) {
    return fail(ErrorKind::invalidArgument,
                fmt::format("{} needs the project that the walk was made from", what),
                options.project.string());
  };
  if (options.mode != "picture") return needsProject("--mode");
  if (options.renderer == "truth") return needsProject("--renderer truth");
  const auto player = playerFor(options.project, common.runner()->threads());
  if (!player) return tl::unexpected(player.error());
  const Bundle& bundle = (*player)->bundle();
  const auto wanted = viewOf(options, bundle);
  if (!wanted) return tl::unexpected(wanted.error());
  PerspectiveView view = *wanted;
  view.width = size->width, view.height = size->height;
  ViewSettings settings = bundle.view;
  if (!options.renderer.empty()) {
    const auto renderer = parseRenderer(options.renderer);
    if (!renderer) return tl::unexpected(renderer.error());
    settings.renderer = *renderer;
  }
  settings.renderer = withoutOpenGl(settings.renderer);
  const Stopwatch watch;
  const auto frame = bundleFrame(**player, view, settings);
  if (!frame) return tl::unexpected(frame.error());
  if (Status written = writeColourImage(frame->colour, options.output); !written)
    return tl::unexpected(written.error());
  if (Status there = mustExist(options.output); !there) return tl::unexpected(there.error());
  if (!options.holes.empty())
    if (Status written = writeColourImage(frame->holeMask(), options.holes); !written)
      return tl::unexpected(written.error());
  Report report;
  report.json = {{"picture", options.output.string()},
                 {"renderer", nameOf(settings.renderer)},
                 {"eye", toJson(view.eye)},
                 {"width", view.width},
                 {"height", view.height},
                 {"openShare", double(frame->holeCount()) / (double(view.width) * view.height)},
                 {"stats", toJson(frame->stats)},
                 {"warnings", Json::array()}};
  report.text = fmt::format("{}\n", options.output.string());
  if (options.stats)
    report.text += fmt::format("  {:.0f} ms with loading; {} images ({} missing)\n", watch.seconds() * 1e3,
                               frame->stats.images, frame->stats.missingImages);
  return report;
}

}  // namespace acentric::cli
