#include <fmt/format.h>

#include <cmath>

#include "engine/cli/commands.h"
#include "engine/inspect/estimate_picture.h"
#include "engine/pipeline/estimate_bake.h"

namespace acentric::cli {
namespace {

Json toJson(const Figure& figure) {
  return {{"value", figure.value}, {"relativeError", figure.relativeError}};
}

std::string countOf(const Figure& figure) { return countText(std::uint64_t(std::llround(figure.value))); }
std::string bytesOf(const Figure& figure) { return bytesText(std::uint64_t(std::llround(figure.value))); }
double percent(const Figure& figure) { return 100 * figure.relativeError; }

struct StoreyEstimate {
  Report report;
  double bytes = 0, seconds = 0;
};

Result<StoreyEstimate> estimateStorey(const OpenProject& open, const EstimateCommandOptions& options,
                                      double effort, const Common& common, TaskRunner& runner) {
  std::vector<int> missing;
  const std::vector<bool> baked = bakedCameras(open);
  for (std::size_t c = 0; c < baked.size(); ++c)
    if (!baked[c]) missing.push_back(int(c));

  EstimateOptions estimating;
  estimating.effort = effort;
  const auto estimate = estimateProjectBake(open, {}, estimating, runner, common.progress, common.stop);
  if (!estimate) return tl::unexpected(estimate.error());
  const BakeEstimate& e = *estimate;
  const double share = baked.empty() ? 0 : double(missing.size()) / double(baked.size());

  Report report;
  report.json = {{"project", options.project.string()},
                 {"threads", runner.threads()},
                 {"cameras", e.cameras},
                 {"missingCameras", missing.size()},
                 {"megapixels", e.pixels / 1e6},
                 {"samples", toJson(e.samples)},
                 {"rays", toJson(e.rays)},
                 {"gatheredRays", e.gatheredRays},
                 {"captureBytes", toJson(e.captureBytes)},
                 {"traceSeconds", toJson(e.traceSeconds)},
                 {"writeSeconds", toJson(e.writeSeconds)},
                 {"sightSeconds", e.sightSeconds},
                 {"captureSeconds", toJson(e.captureSeconds)},
                 {"surfaceLight",
                  {{"samples", toJson(e.lightSamples)},
                   {"bytes", toJson(e.lightBytes)},
                   {"seconds", toJson(e.lightSeconds)}}},
                 {"bytes", toJson(e.bytes)},
                 {"seconds", toJson(e.seconds)},
                 {"probedCameras", e.probedCameras},
                 {"probeSeconds", e.probeSeconds}};
  report.text = fmt::format(
      "{} cameras{}, {:.1f} Mpixel: {} samples (+-{:.0f} %), {} rays\n"
      "captures       {:>10} (+-{:.0f} %)   {:>9} (+-{:.0f} %; tracing {}, writing {}, side by side)\n"
      "surface light  {:>10} (+-{:.0f} %)   {:>9} (+-{:.0f} %; {} samples)\n"
      "together       {:>10}            {:>9} with {} threads\n"
      "probed {} cameras in {:.1f} s; {} of {} cameras are missing: about {} for them\n",
      e.cameras, storeyText(open.project), e.pixels / 1e6, countOf(e.samples), percent(e.samples),
      countOf(e.rays), bytesOf(e.captureBytes), percent(e.captureBytes), timeText(e.captureSeconds.value),
      percent(e.captureSeconds), timeText(e.traceSeconds.value), timeText(e.writeSeconds.value),
      bytesOf(e.lightBytes), percent(e.lightBytes), timeText(e.lightSeconds.value), percent(e.lightSeconds),
      countOf(e.lightSamples), bytesOf(e.bytes), timeText(e.seconds.value), runner.threads(), e.probedCameras,
      e.probeSeconds, missing.size(), baked.size(), timeText(share * e.captureSeconds.value));
  if (!options.output.empty()) {
    std::vector<double> pixels;
    for (const LayoutCamera& camera : open.layout->cameras) pixels.push_back(pixelsOf(open, camera));
    const auto picture = pictureOf(*open.layout, pixels, e, open.scene->name + ": estimate of the bake");
    if (Status written = writePlanPicture(picture, options.output); !written)
      return tl::unexpected(written.error());
    report.json["picture"] = options.output.string();
    report.text += fmt::format("wrote {}\n", options.output.string());
  }
  return StoreyEstimate{std::move(report), e.bytes.value, e.seconds.value};
}

}  // namespace

Result<Report> runEstimate(const EstimateCommandOptions& options, const Common& common) {
  const auto storeys = openStoreys(options.project, common);
  if (!storeys) return tl::unexpected(storeys.error());
  if (!options.output.empty() && storeys->size() > 1)
    return fail(ErrorKind::invalidArgument, "a picture is of one storey: say with --storey which", "-o");
  const auto runner = common.runner();
  std::vector<Report> reports;
  double bytes = 0, seconds = 0;
  for (const OpenProject& open : *storeys) {
    auto one = estimateStorey(open, options, options.effort / double(storeys->size()), common, *runner);
    if (!one) return tl::unexpected(one.error());
    reports.push_back(std::move(one->report));
    bytes += one->bytes, seconds += one->seconds;
  }
  Report report = byStorey(*storeys, std::move(reports));
  if (storeys->size() == 1) return report;
  report.json["bytes"] = bytes;
  report.json["seconds"] = seconds;
  report.text += fmt::format("all storeys    {:>10}            {:>9}\n",
                             bytesText(std::uint64_t(std::llround(bytes))), timeText(seconds));
  return report;
}

}  // namespace acentric::cli
