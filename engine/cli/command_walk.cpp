#include <fmt/format.h>

#include <algorithm>

#include "engine/cli/commands.h"
#include "engine/cli/path_frames.h"
#include "engine/measure/compare.h"
#include "engine/measure/statistics.h"

namespace acentric::cli {
namespace {

constexpr std::size_t kSheetPictures = 12;
constexpr int kSheetColumns = 4;

}  // namespace

Result<Report> runTour(const TourOptions& options, const Common& common) {
  const auto open = openChosen(options.project, common);
  if (!open) return tl::unexpected(open.error());
  const CameraPath path = tourOf(*open->layout, open->project.spawn().position, options.frames);
  if (Status saved = savePath(path, options.output); !saved) return tl::unexpected(saved.error());
  if (Status there = mustExist(options.output); !there) return tl::unexpected(there.error());
  Report report;
  report.json = {{"path", options.output.string()}, {"frames", path.poses.size()}};
  report.text = fmt::format("{}: {} frames\n", options.output.string(), path.poses.size());
  return report;
}

Result<Report> runWalk(const WalkOptions& options, const Common& common) {
  const auto walk =
      openAlong(options.project, options.path, options.size, options.fovDegrees, kTourFrames, common);
  if (!walk) return tl::unexpected(walk.error());
  const auto& views = walk->views;
  const auto runner = common.runner();
  auto maker = FrameMaker::create(walk->storeys, options.renderer, common, *runner, options.reconstruction);
  if (!maker) return tl::unexpected(maker.error());

  std::vector<ColourImage> pictures;
  std::vector<double> milliseconds;
  std::uint64_t openPixels = 0;
  const std::size_t stride = std::max<std::size_t>(1, (views.size() + kSheetPictures - 1) / kSheetPictures);
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (common.stop.stop_requested())
      return fail(ErrorKind::cancelled, "stopped; the frames written so far are complete",
                  options.output.string());
    if (common.progress) common.progress({double(i), double(views.size()), "rendering"});
    auto frame = (*maker)->render(views[i]);
    if (!frame) return tl::unexpected(frame.error());
    const auto file = options.output / fmt::format("frame_{:05}.png", i);
    if (Status written = writeColourImage(frame->colour, file); !written)
      return tl::unexpected(written.error());
    if (Status there = mustExist(file); !there) return tl::unexpected(there.error());
    milliseconds.push_back(frame->stats.totalSeconds * 1e3);
    openPixels += frame->holeCount();
    if (i % stride == 0) pictures.push_back(std::move(frame->colour));
  }
  const auto sheet = options.output / "contact_sheet.png";
  if (Status written = writeColourImage(contactSheet(pictures, kSheetColumns), sheet); !written)
    return tl::unexpected(written.error());

  const Spread spread = spreadOf(milliseconds);
  const double openShare =
      double(openPixels) / (double(walk->size.width) * walk->size.height * double(views.size()));
  Report report;
  report.json = {{"folder", options.output.string()},
                 {"frames", views.size()},
                 {"contactSheet", sheet.string()},
                 {"renderer", options.renderer},
                 {"frameMsMedian", spread.median},
                 {"frameMsP99", spread.p99},
                 {"openShare", openShare},
                 {"warnings", (*maker)->warnings()}};
  report.text = fmt::format("{} frames in {}; contact sheet {}\n", views.size(), options.output.string(),
                            sheet.string());
  if (!(*maker)->isTruth())
    report.text += fmt::format(
        "  {:.1f} ms a frame (median), {:.1f} ms (99th percentile), {:.3f} % of the pixels without a "
        "sample\n",
        spread.median, spread.p99, 100 * openShare);
  for (const std::string& warning : (*maker)->warnings()) report.text += "warning: " + warning + "\n";
  return report;
}

}  // namespace acentric::cli
