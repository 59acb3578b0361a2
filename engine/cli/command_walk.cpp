#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "engine/base/file.h"
#include "engine/cli/commands.h"
#include "engine/cli/frame_pictures.h"
#include "engine/cli/path_frames.h"
#include "engine/geometry/conventions.h"
#include "engine/measure/compare.h"
#include "engine/measure/statistics.h"
#include "engine/picture/captioned_pictures.h"

namespace acentric::cli {
namespace {

constexpr std::size_t kSheetPictures = 12, kSheetRows = 6;
constexpr std::size_t kSheetColumns = 4;
constexpr int kSheetPictureWidth = 480;

/// A frame as its files are numbered, and how near the truth it is, where that is known.
struct WalkedFrame {
  PerspectiveView view;
  double milliseconds = 0, openShare = 0;
  std::optional<Comparison> comparison;
};

std::string captionOf(std::size_t number, const WalkedFrame& frame) {
  if (!frame.comparison) return fmt::format("frame {}", number);
  return fmt::format("{:.1f} dB, SSIM {:.3f}, holes {:.3f} %", frame.comparison->psnr, frame.comparison->ssim,
                     100 * frame.comparison->holeShare);
}

Json toJson(const WalkedFrame& frame) {
  Json json = {{"eye", cli::toJson(frame.view.eye)},
               {"yaw", degrees(frame.view.yawRadians)},
               {"pitch", degrees(frame.view.pitchRadians)},
               {"frameMs", frame.milliseconds},
               {"openShare", frame.openShare}};
  if (frame.comparison) {
    json["psnr"] = frame.comparison->psnr;
    json["ssim"] = frame.comparison->ssim;
    json["holeShare"] = frame.comparison->holeShare;
  }
  return json;
}

std::string csvOf(const std::vector<WalkedFrame>& frames) {
  std::string csv = "frame,x,y,z,yaw,pitch,ms,open_share,psnr,ssim,hole_share\n";
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto& [view, milliseconds, openShare, comparison] = frames[i];
    csv += fmt::format("{},{:.6f},{:.6f},{:.6f},{:.4f},{:.4f},{:.3f},{:.8f},", i, view.eye.x, view.eye.y,
                       view.eye.z, degrees(view.yawRadians), degrees(view.pitchRadians), milliseconds,
                       openShare);
    csv += comparison ? fmt::format("{:.4f},{:.6f},{:.8f}\n", comparison->psnr, comparison->ssim,
                                    comparison->holeShare)
                      : ",,\n";
  }
  return csv;
}

/// What the files of a mode are called.
std::string filePrefix(PictureMode mode) { return mode == PictureMode::picture ? "frame" : nameOf(mode); }

std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

/// How the frames of a mode become a video. Its sides must be even.
std::string videoCommand(const std::filesystem::path& folder, PictureMode mode, std::size_t frames) {
  // A percent sign in the folder's name would be taken for a number's place.
  std::string name = folder.string();
  for (std::size_t at = 0; (at = name.find('%', at)) != std::string::npos; at += 2) name.insert(at, 1, '%');
  const std::string prefix = filePrefix(mode);
  return fmt::format(
      "ffmpeg -framerate {} -i {} -frames:v {} -vf 'pad=ceil(iw/2)*2:ceil(ih/2)*2' -c:v libx264 "
      "-pix_fmt yuv420p {}",
      kPathRate, quoted(name + "/" + prefix + "_%05d.png"), frames,
      quoted((folder / (prefix + ".mp4")).string()));
}

/// The contact sheet: of one mode in a grid, of several each frame's in a row.
class ContactSheet {
 public:
  ContactSheet(std::span<const PictureMode> modes, std::size_t frames, int width)
      : single_(modes.size() == 1) {
    const std::size_t most = single_ ? kSheetPictures : kSheetRows;
    stride_ = std::max<std::size_t>(1, (frames + most - 1) / most);
    sheet_.pictureWidth = std::min(width, kSheetPictureWidth);
    if (!single_)
      for (const PictureMode mode : modes) sheet_.headings.emplace_back(nameOf(mode));
  }
  bool wants(std::size_t frame) const { return frame % stride_ == 0; }
  void add(std::size_t number, const WalkedFrame& frame, std::vector<ColourImage> pictures) {
    if (!single_ || sheet_.rows.empty() || sheet_.rows.back().pictures.size() == kSheetColumns)
      sheet_.rows.push_back({single_ ? "" : fmt::format("{}", number), {}});
    for (std::size_t p = 0; p < pictures.size(); ++p)
      sheet_.rows.back().pictures.push_back({std::move(pictures[p]), p == 0 ? captionOf(number, frame) : ""});
  }
  void note(std::string text) { sheet_.notes.push_back(std::move(text)); }
  Status write(const std::filesystem::path& file) const {
    const auto drawn = drawSheet(sheet_);
    if (!drawn) return tl::unexpected(drawn.error());
    return writeColourImage(*drawn, file);
  }

 private:
  bool single_;
  std::size_t stride_ = 1;
  Sheet sheet_;
};

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
  const std::vector<PictureMode> modes = pictureModes(options.modes);
  if (options.renderer == "truth" && modes != std::vector{PictureMode::picture})
    return fail(ErrorKind::invalidArgument,
                "--renderer truth has no cameras and nothing to compare with: leave --modes away");
  const auto walk =
      openAlong(options.project, options.path, options.size, options.fovDegrees, kTourFrames, common);
  if (!walk) return tl::unexpected(walk.error());
  const auto& views = walk->views;
  const OpenProject& open = walk->storeys.front();
  const auto runner = common.runner();
  auto maker = FrameMaker::create(walk->storeys, options.renderer, common, *runner, options.look);
  if (!maker) return tl::unexpected(maker.error());
  (*maker)->truthSamples = options.truthSamples;
  const FramePictures shown(walk->storeys, options.gain);

  std::vector<WalkedFrame> walked;
  ContactSheet sheet(modes, views.size(), walk->size.width);
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (common.stop.stop_requested())
      return fail(ErrorKind::cancelled, "stopped; the frames written so far are complete",
                  options.output.string());
    if (common.progress) common.progress({double(i), double(views.size()), "rendering"});
    auto frame = (*maker)->render(views[i]);
    if (!frame) return tl::unexpected(frame.error());
    WalkedFrame record{views[i], frame->stats.totalSeconds * 1e3,
                       double(frame->holeCount()) / double(frame->source.pixels.size()), std::nullopt};
    std::optional<TruthFrame> truth;
    if (needsTruth(modes)) {
      truth = renderTruth(*open.rays, views[i], open.project.bake, open.project.exposure,
                          options.truthSamples, *runner);
      const auto comparison = compare(*frame, truth->colour, truth->rayDistance);
      if (!comparison) return tl::unexpected(comparison.error());
      record.comparison = *comparison;
    }
    std::vector<ColourImage> pictures;
    for (const PictureMode mode : modes) {
      pictures.push_back(shown.make(mode, *frame, views[i], truth ? &*truth : nullptr));
      const auto file = options.output / fmt::format("{}_{:05}.png", filePrefix(mode), i);
      if (Status written = writeColourImage(pictures.back(), file); !written)
        return tl::unexpected(written.error());
      if (Status there = mustExist(file); !there) return tl::unexpected(there.error());
    }
    if (sheet.wants(i)) sheet.add(i, record, std::move(pictures));
    walked.push_back(std::move(record));
    (*maker)->recycle(std::move(*frame));
  }
  if (std::ranges::count(modes, PictureMode::difference))
    sheet.note(fmt::format("Differences are amplified {} times.", options.gain));
  if (needsTruth(modes))
    sheet.note(
        fmt::format("Truth: {} rays per pixel. Holes: pixels without a sample where the truth has a "
                    "surface.",
                    options.truthSamples));
  const auto sheetFile = options.output / "contact_sheet.png", table = options.output / "frames.csv";
  if (Status written = sheet.write(sheetFile); !written) return tl::unexpected(written.error());
  if (Status written = writeTextAtomically(table, csvOf(walked)); !written)
    return tl::unexpected(written.error());

  const auto spread = [&](const auto& value) {
    std::vector<double> values;
    for (const WalkedFrame& frame : walked) values.push_back(value(frame));
    return spreadOf(std::move(values));
  };
  const Spread time = spread([](const WalkedFrame& f) { return f.milliseconds; });
  double openShare = 0;
  for (const WalkedFrame& frame : walked) openShare += frame.openShare / double(walked.size());
  std::vector<std::string> commands;
  for (const PictureMode mode : modes) commands.push_back(videoCommand(options.output, mode, views.size()));
  Report report;
  report.json = {
      {"folder", options.output.string()},  {"frames", views.size()},          {"modes", options.modes},
      {"contactSheet", sheetFile.string()}, {"table", table.string()},         {"renderer", (*maker)->name()},
      {"frameMsMedian", time.median},       {"frameMsP99", time.p99},          {"openShare", openShare},
      {"videoCommands", commands},          {"warnings", (*maker)->warnings()}};
  report.text = fmt::format("{} frames in {}; contact sheet {}, table {}\n", views.size(),
                            options.output.string(), sheetFile.string(), table.string());
  if (!(*maker)->isTruth())
    report.text += fmt::format(
        "  {:.1f} ms a frame (median), {:.1f} ms (99th percentile), {:.3f} % of the pixels without a "
        "sample\n",
        time.median, time.p99, 100 * openShare);
  if (needsTruth(modes)) {
    const Spread psnr = spread([](const WalkedFrame& f) { return f.comparison->psnr; });
    const Spread ssim = spread([](const WalkedFrame& f) { return f.comparison->ssim; });
    const Spread holes = spread([](const WalkedFrame& f) { return f.comparison->holeShare; });
    report.json["gain"] = options.gain;
    report.json["truthSamples"] = options.truthSamples;
    report.json["measured"] = Json::array();
    for (const WalkedFrame& frame : walked) report.json["measured"].push_back(toJson(frame));
    report.text += fmt::format(
        "  against {} rays per pixel: PSNR {:.2f} dB median, {:.2f} dB worst; SSIM {:.4f} and {:.4f}; holes "
        "{:.3f} % and {:.3f} %\n",
        options.truthSamples, psnr.median, psnr.min, ssim.median, ssim.min, 100 * holes.median,
        100 * holes.max);
  }
  for (const std::string& warning : (*maker)->warnings()) report.text += "warning: " + warning + "\n";
  for (const std::string& command : commands) report.text += "video: " + command + "\n";
  return report;
}

}  // namespace acentric::cli
