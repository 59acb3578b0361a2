#include <fmt/format.h>

#include <algorithm>

#include "engine/cli/attribution_report.h"
#include "engine/cli/commands.h"
#include "engine/cli/machine/machine.h"
#include "engine/cli/path_frames.h"
#include "engine/cli/seam_report.h"
#include "engine/measure/compare.h"
#include "engine/measure/statistics.h"

namespace acentric::cli {
namespace {

Json toJson(const Spread& spread) {
  return {{"min", spread.min}, {"median", spread.median}, {"p99", spread.p99}, {"max", spread.max}};
}

Status writeTriple(const std::filesystem::path& folder, std::size_t index, const Frame& frame,
                   const TruthFrame& truth) {
  const ColourImage sheet = contactSheet(
      {frame.colour, truth.colour, differenceImage(frame.colour, truth.colour), frame.holeMask()}, 2);
  return writeColourImage(sheet, folder / fmt::format("compare_{:05}.png", index));
}

}  // namespace

Result<Report> runMeasure(const MeasureOptions& options, const Common& common) {
  if (options.renderer == "truth")
    return fail(ErrorKind::invalidArgument, "--renderer truth would compare the truth with itself");
  const auto walk =
      openAlong(options.project, options.path, options.size, options.fovDegrees, kTourFrames, common);
  if (!walk) return tl::unexpected(walk.error());
  const OpenProject& open = walk->storeys.front();
  const auto views = evenly(walk->views, options.frames);
  const auto runner = common.runner();
  auto maker = FrameMaker::create(walk->storeys, options.renderer, common, *runner, options.look);
  if (!maker) return tl::unexpected(maker.error());

  std::vector<double> psnr, ssim, holes, milliseconds;
  SeamSums seams;
  AttributionReport attribution(open.project.bake.samplesPerDegree);
  Json frames = Json::array();
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (common.stop.stop_requested()) return fail(ErrorKind::cancelled, "stopped");
    if (common.progress) common.progress({double(i), double(views.size()), "measuring"});
    const auto frame = (*maker)->render(views[i]);
    if (!frame) return tl::unexpected(frame.error());
    const TruthFrame truth = renderTruth(*open.rays, views[i], open.project.bake, open.project.exposure,
                                         options.truthSamples, *runner);
    const auto comparison = compare(*frame, truth.colour, truth.rayDistance);
    if (!comparison) return tl::unexpected(comparison.error());
    if (options.attribution)
      attribution.add(*frame, truth, viewDependentPixels(*open.rays, views[i], views[i].pixels(), *runner),
                      views[i]);
    if (options.seams) seams += measureSeam(*frame, truth.colour, truth.rayDistance);
    if (!options.images.empty())
      if (Status written = writeTriple(options.images, i, *frame, truth); !written)
        return tl::unexpected(written.error());
    psnr.push_back(comparison->psnr);
    ssim.push_back(comparison->ssim);
    holes.push_back(comparison->holeShare);
    milliseconds.push_back(frame->stats.totalSeconds * 1e3);
    frames.push_back({{"eye", cli::toJson(views[i].eye)},
                      {"psnr", psnr.back()},
                      {"ssim", ssim.back()},
                      {"holeShare", holes.back()},
                      {"frameMs", milliseconds.back()}});
  }
  const Spread p = spreadOf(psnr), s = spreadOf(ssim), h = spreadOf(holes), m = spreadOf(milliseconds);
  Report report;
  report.json = measuredOn(runner->threads());
  report.json.update({{"project", options.project.string()},
                      {"renderer", (*maker)->name()},
                      {"reconstruction", nameOf((*maker)->settings.reconstruction)},
                      {"width", walk->size.width},
                      {"height", walk->size.height},
                      {"psnr", toJson(p)},
                      {"ssim", toJson(s)},
                      {"holeShare", toJson(h)},
                      {"frameMs", toJson(m)},
                      {"frames", std::move(frames)},
                      {"warnings", (*maker)->warnings()}});
  report.text = fmt::format(
      "{} frames of {}x{}, renderer {}, {} threads\n"
      "  PSNR       median {:6.2f} dB   worst {:6.2f} dB\n"
      "  SSIM       median {:6.4f}      worst {:6.4f}\n"
      "  hole share median {:6.3f} %    worst {:6.3f} %\n"
      "  frame time median {:6.1f} ms   p99   {:6.1f} ms\n",
      views.size(), walk->size.width, walk->size.height, (*maker)->name(), runner->threads(), p.median, p.min,
      s.median, s.min, 100 * h.median, 100 * h.max, m.median, m.p99);
  if (options.attribution) {
    report.json["attribution"] = attribution.json();
    report.text += attribution.text();
  }
  if (options.seams) {
    const auto pops =
        measurePopping(*walk, options.crossings, **maker, options.truthSamples, *runner, common);
    if (!pops) return tl::unexpected(pops.error());
    const SeamReport seam = reportSeam(seams), popping = reportPopping(*pops);
    report.json["seams"] = seam.json;
    report.json["popping"] = popping.json;
    report.text += seam.text + popping.text;
  }
  return report;
}

}  // namespace acentric::cli
