#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "engine/base/stopwatch.h"
#include "engine/cli/bundle_picture.h"
#include "engine/cli/commands.h"
#include "engine/cli/frame_pictures.h"
#include "engine/export/walk_read.h"
#include "engine/geometry/conventions.h"

namespace acentric::cli {

Result<PerspectiveView> chosenView(const ViewChoice& options, const OpenProject& open) {
  const auto size = parseSize(options.size);
  if (!size) return tl::unexpected(size.error());
  if (!options.bookmark.empty()) {
    const auto bookmark = bookmarkOf(open.project, options.bookmark);
    if (!bookmark) return tl::unexpected(bookmark.error());
    return viewAt({bookmark->eye, bookmark->yawRadians, bookmark->pitchRadians}, bookmark->fovDegrees,
                  {size->width, size->height});
  }
  PathPose pose{{open.project.spawn().position, open.layout->eyeZ()},
                options.yawDegrees    ? radians(*options.yawDegrees)
                : options.eye.empty() ? open.project.spawn().yawRadians
                                      : 0,
                radians(options.pitchDegrees)};
  if (!options.eye.empty()) {
    const auto eye = parseEye(options.eye, open.layout->eyeZ());
    if (!eye) return tl::unexpected(eye.error());
    pose.eye = *eye;
  }
  return viewAt(pose, options.fovDegrees, {size->width, size->height});
}

Result<std::vector<OpenProject>> storeysFor(const ViewChoice& choice, const OpenProject& current,
                                            const Common& common) {
  if (!common.storey.empty() || (choice.eye.empty() && choice.bookmark.empty()))
    return std::vector<OpenProject>{current};
  return acentric::openStoreys(current, common.host, common.progress, common.stop);
}

Result<glm::dvec3> parseEye(const std::string& text, double eyeZ) {
  glm::dvec3 eye(0, 0, eyeZ);
  const char* at = text.data();
  const char* const end = at + text.size();
  int count = 0;
  while (at < end && count < 3) {
    const auto [next, error] = std::from_chars(at, end, eye[count]);
    if (error != std::errc{} || !std::isfinite(eye[count])) break;
    ++count;
    at = next;
    if (at < end && *at == ',')
      ++at;
    else
      break;
  }
  if (at != end || count < 2 || text.ends_with(','))
    return fail(ErrorKind::invalidArgument,
                fmt::format("--eye '{}': give x,y or x,y,z in metres, such as 1.5,-2,1.6", text));
  return eye;
}

Result<PictureSize> parseSize(const std::string& text) {
  PictureSize size;
  const auto cross = text.find('x');
  const auto number = [](std::string_view part, int& out) {
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), out);
    return error == std::errc{} && end == part.data() + part.size() && out >= 1 && out <= 16384;
  };
  if (cross == std::string::npos || !number(std::string_view(text).substr(0, cross), size.width) ||
      !number(std::string_view(text).substr(cross + 1), size.height))
    return fail(ErrorKind::invalidArgument,
                fmt::format("--size '{}': give WIDTHxHEIGHT in pixels, such as 960x540", text));
  return size;
}

Result<Report> runRender(const RenderOptions& options, const Common& common) {
  if (isBundle(options.project)) return renderBundle(options, common);
  const PictureMode mode = pictureModes({{options.mode}}).front();
  if (options.renderer == "truth" && mode != PictureMode::picture)
    return fail(ErrorKind::invalidArgument,
                "--renderer truth has no cameras and nothing to compare with: leave --mode away");
  auto current = openChosen(options.project, common);
  if (!current) return tl::unexpected(current.error());

  const auto chosen = chosenView(options, *current);
  if (!chosen) return tl::unexpected(chosen.error());
  const PerspectiveView& view = *chosen;

  const auto runner = common.runner();
  const auto opened = storeysFor(options, *current, common);
  if (!opened) return tl::unexpected(opened.error());
  const std::vector<OpenProject>& storeys = *opened;
  auto maker = FrameMaker::create(storeys, options.renderer, common, *runner, options.look);
  if (!maker) return tl::unexpected(maker.error());
  if (Status loaded = (*maker)->load(view); !loaded) return tl::unexpected(loaded.error());
  (*maker)->truthSamples = options.truthSamples;
  const Stopwatch watch;
  const auto frame = (*maker)->render(view);
  if (!frame) return tl::unexpected(frame.error());
  const double seconds = watch.seconds();

  const FramePictures pictures(storeys, options.gain);
  const OpenProject& open = storeys.front();
  std::optional<TruthFrame> truth;
  if (needsTruth(mode))
    truth = renderTruth(*open.rays, view, open.project.bake, open.project.exposure, options.truthSamples,
                        *runner);
  const auto picture = pictures.makeWithLegend(mode, *frame, view, truth ? &*truth : nullptr);
  if (!picture) return tl::unexpected(picture.error());
  if (Status written = writeColourImage(*picture, options.output); !written)
    return tl::unexpected(written.error());
  if (Status there = mustExist(options.output); !there) return tl::unexpected(there.error());
  if (!options.holes.empty())
    if (Status written = writeColourImage(frame->holeMask(), options.holes); !written)
      return tl::unexpected(written.error());

  const double holeShare = double(frame->holeCount()) / (double(view.width) * view.height);
  Report report;
  report.json = {{"picture", options.output.string()},
                 {"mode", options.mode},
                 {"renderer", (*maker)->name()},
                 {"eye", toJson(view.eye)},
                 {"width", view.width},
                 {"height", view.height},
                 {"openShare", holeShare},
                 {"renderMs", seconds * 1e3},
                 {"stats", toJson(frame->stats)},
                 {"warnings", (*maker)->warnings()}};
  if (mode == PictureMode::sources) report.json["sources"] = pictures.sourcesJson(*frame, view);
  if (mode == PictureMode::difference) report.json["gain"] = options.gain;
  report.text = fmt::format("{}\n", options.output.string());
  for (const std::string& warning : (*maker)->warnings()) report.text += "warning: " + warning + "\n";
  if (options.stats && (*maker)->isTruth())
    report.text += fmt::format("  {:.0f} ms, ray-traced\n", seconds * 1e3);
  if (options.stats && !(*maker)->isTruth())
    report.text += fmt::format(
        "  {:.1f} ms (warp {:.1f}, local geometry {:.1f}, fill {:.1f}); {} images ({} missing), {} samples "
        "read, {} drawn, {} local "
        "triangles; {:.3f} % of the pixels without a sample\n",
        seconds * 1e3, frame->stats.warpSeconds * 1e3, frame->stats.localSeconds * 1e3,
        frame->stats.fillSeconds * 1e3, frame->stats.images, frame->stats.missingImages,
        countText(frame->stats.samplesRead), countText(frame->stats.samplesDrawn),
        countText(frame->stats.localTriangles), 100 * holeShare);
  return report;
}

}  // namespace acentric::cli
