#include "engine/cli/bundle_picture.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/stopwatch.h"
#include "engine/cli/frame_pictures.h"
#include "engine/export/walk_pages.h"
#include "engine/geometry/conventions.h"
#include "engine/layout/storey_choice.h"

namespace acentric::cli {

Result<std::unique_ptr<BundlePlayer>> playerFor(std::unique_ptr<BundleFiles> files, int threads) {
  auto player = std::make_unique<BundlePlayer>();
  if (Status opened = player->open(std::move(files)); !opened) return tl::unexpected(opened.error());
  player->setThreads(threads);
  return player;
}

PerspectiveView startOf(const Bundle& bundle) {
  const BundleStorey& storey = bundle.storeys[std::size_t(bundle.storey)];
  PerspectiveView view;
  view.eye = {storey.start, storey.layout.eyeZ()};
  view.yawRadians = storey.startYaw;
  view.fovRadians = bundle.fov;
  return view;
}

Result<Frame> bundleFrame(BundlePlayer& player, const PerspectiveView& view, const ViewSettings& settings) {
  const auto needs = player.needsOf(view, settings);
  if (!needs) return tl::unexpected(needs.error());
  const BundleStorey& storey = player.bundle().storeys[needs->storey];
  for (const int camera : needs->cameras) {
    const BundleCamera& renditions = storey.cameras[std::size_t(camera)];
    if (!renditions.full && !renditions.coarse) continue;  // it stays a hole
    const Loaded detail = renditions.full ? Loaded::full : Loaded::coarse;
    if (Status loaded = player.loadCapture(needs->storey, std::size_t(camera), detail); !loaded)
      return tl::unexpected(loaded.error());
  }
  if (Status loaded = player.loadRegion(needs->storey, std::size_t(needs->region)); !loaded)
    return tl::unexpected(loaded.error());
  return player.render(view, settings);
}

namespace {

/// Of a walk that is one file, the place where the eye is: the other pages of its index are not read.
Result<std::unique_ptr<BundlePlayer>> playerAt(WalkPages& pages, const glm::dvec3& eye, int threads) {
  WalkPlacePtr best;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < pages.root().storeys.size(); ++s) {
    if (pages.regionCount(s) == 0) continue;
    auto place = pages.placeAt(s, glm::dvec2(eye));
    if (!place) return tl::unexpected(place.error());
    const double misfit = misfitOf((*place)->here().layout, eye);
    if (!best || misfit < nearest) best = std::move(*place), nearest = misfit;
  }
  auto player = std::make_unique<BundlePlayer>();
  if (best)
    player->open(best->files, best->bundle);
  else
    player->open(nullptr, pages.root());
  player->setThreads(threads);
  return player;
}

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
  const int threads = common.runner()->threads();
  Result<std::unique_ptr<BundlePlayer>> player;
  Result<PerspectiveView> wanted;
  std::error_code error;
  if (std::filesystem::is_directory(options.project, error)) {
    player = playerFor(bundleFolder(options.project), threads);
    if (player) wanted = viewOf(options, (*player)->bundle());
  } else {
    auto ranges = fileRanges(options.project);
    if (!ranges) return tl::unexpected(ranges.error());
    const auto pages = WalkPages::open(std::move(*ranges), options.project.string());
    if (!pages) return tl::unexpected(pages.error());
    wanted = viewOf(options, (*pages)->root());
    if (wanted) player = playerAt(**pages, wanted->eye, threads);
  }
  if (!player) return tl::unexpected(player.error());
  if (!wanted) return tl::unexpected(wanted.error());
  const Bundle& bundle = (*player)->bundle();
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
