#include <fmt/format.h>

#include <algorithm>

#include "engine/base/file.h"
#include "engine/base/json_text.h"
#include "engine/cli/bake_notice.h"
#include "engine/cli/commands.h"
#include "engine/cli/machine/machine.h"
#include "engine/cli/path_frames.h"
#include "engine/geometry/conventions.h"
#include "engine/measure/statistics.h"

namespace acentric::cli {
namespace {

/// Values of a set of views, ascending.
class Ranked {
 public:
  explicit Ranked(std::vector<double> values) : values_(std::move(values)) { std::ranges::sort(values_); }
  Ranked(const ViewSetResult& set, double Comparison::*value) {
    for (const Comparison& comparison : set.comparisons) values_.push_back(comparison.*value);
    std::ranges::sort(values_);
  }
  double at(double share) const { return percentileOf(values_, share); }
  Json json() const {
    return {{"p5", at(0.05)},  {"p25", at(0.25)}, {"median", at(0.5)},
            {"p75", at(0.75)}, {"p95", at(0.95)}, {"max", at(1)}};
  }

 private:
  std::vector<double> values_;
};

Ranked millisecondsOf(const ViewSetResult& set) {
  std::vector<double> values;
  for (const double seconds : set.frameSeconds) values.push_back(1e3 * seconds);
  return Ranked(std::move(values));
}

Json toJson(const RepresentationResult& result, const std::vector<ViewSet>& sets) {
  const RepresentationCost& cost = result.cost;
  Json json = {{"name", result.name},
               {"description", result.description},
               {"bytes", cost.bytes()},
               {"captureBytes", cost.captureBytes},
               {"lightBytes", cost.lightBytes},
               {"meshBytes", cost.meshBytes},
               {"samplesPerDegree", cost.samplesPerDegree},
               {"cameras", cost.cameras},
               {"samples", cost.samples},
               {"triangles", cost.triangles},
               {"bakeSeconds", cost.bakeSeconds},
               {"reused", cost.reused},
               {"sets", Json::array()}};
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const ViewSetResult& set = result.sets[s];
    Json frames = Json::array();
    for (std::size_t v = 0; v < set.comparisons.size(); ++v) {
      const Comparison& c = set.comparisons[v];
      frames.push_back({{"holeShare", c.holeShare},
                        {"psnr", c.psnr},
                        {"ssim", c.ssim},
                        {"frameMs", 1e3 * set.frameSeconds[v]}});
    }
    json["sets"].push_back({{"name", sets[s].name},
                            {"holeShare", Ranked(set, &Comparison::holeShare).json()},
                            {"psnr", Ranked(set, &Comparison::psnr).json()},
                            {"ssim", Ranked(set, &Comparison::ssim).json()},
                            {"frameMs", millisecondsOf(set).json()},
                            {"frames", std::move(frames)}});
  }
  return json;
}

std::string qualityTable(const RepresentationBench& bench, std::size_t s) {
  std::string table = fmt::format(
      "{}, {} frames: median and worse 5 %\n  {:<10} {:>10} {:>10} {:>9} {:>9} {:>7} {:>7} {:>9}\n",
      bench.sets[s].name, bench.sets[s].views.size(), "", "holes", "p95", "PSNR", "p5", "SSIM", "p5",
      "frame");
  for (const RepresentationResult& result : bench.results) {
    const ViewSetResult& set = result.sets[s];
    const Ranked holes(set, &Comparison::holeShare), psnr(set, &Comparison::psnr),
        ssim(set, &Comparison::ssim);
    table +=
        fmt::format("  {:<10} {:>8.3f} % {:>8.3f} % {:>6.2f} dB {:>6.2f} dB {:>7.4f} {:>7.4f} {:>6.1f} ms\n",
                    result.name, 100 * holes.at(0.5), 100 * holes.at(0.95), psnr.at(0.5), psnr.at(0.05),
                    ssim.at(0.5), ssim.at(0.05), millisecondsOf(set).at(0.5));
  }
  return table;
}

std::string costTable(const RepresentationBench& bench) {
  std::string table = fmt::format("  {:<10} {:>10} {:>8} {:>9} {:>8} {:>13} {:>11} {:>10}\n", "", "bytes", "",
                                  "captures", "/degree", "samples", "triangles", "bake");
  const double own = double(bench.results.front().cost.bytes());
  for (const RepresentationResult& result : bench.results) {
    const RepresentationCost& cost = result.cost;
    table += fmt::format("  {:<10} {:>10} {:>6.1f} % {:>9} {:>8.2f} {:>13} {:>11} {:>10}\n", result.name,
                         bytesText(cost.bytes()), 100 * double(cost.bytes()) / own, cost.cameras,
                         cost.samplesPerDegree, countText(cost.samples), countText(cost.triangles),
                         timeText(cost.bakeSeconds));
  }
  for (const RepresentationResult& result : bench.results)
    table += fmt::format("  {}: {}\n", result.name, result.description);
  return table;
}

Json setsJson(const std::vector<ViewSet>& sets) {
  Json json = Json::array();
  for (const ViewSet& set : sets) {
    Json views = Json::array();
    for (const PerspectiveView& view : set.views)
      views.push_back({{"eye", cli::toJson(view.eye)},
                       {"yaw", degrees(view.yawRadians)},
                       {"pitch", degrees(view.pitchRadians)}});
    json.push_back({{"name", set.name}, {"views", std::move(views)}});
  }
  return json;
}

}  // namespace

Result<Report> runBenchRepresentations(const BenchRepresentationsOptions& options, const Common& common) {
  const auto size = parseSize(options.size);
  if (!size) return tl::unexpected(size.error());
  RepresentationBenchOptions bench = options.bench;
  bench.width = size->width, bench.height = size->height;
  bench.tell = tellerTo(common);
  const auto open = openChosen(options.project, common);
  if (!open) return tl::unexpected(open.error());
  std::vector<ViewSet> paths;
  for (const std::filesystem::path& path : options.paths) {
    auto views = viewsOn(*open, path, *size, bench.fovDegrees);
    if (!views) return tl::unexpected(views.error());
    paths.push_back({"path " + path.stem().string(), std::move(*views)});
  }
  const auto runner = common.runner();
  const auto measured =
      benchRepresentations(*open, paths, options.output, bench, *runner, common.progress, common.stop);
  if (!measured) return tl::unexpected(measured.error());

  Report report;
  report.json = measuredOn(runner->threads());
  report.json.update({{"project", options.project.string()},
                      {"width", bench.width},
                      {"height", bench.height},
                      {"seed", bench.seed},
                      {"truthSamples", bench.truthSamples},
                      {"sets", setsJson(measured->sets)},
                      {"representations", Json::array()}});
  for (const RepresentationResult& result : measured->results)
    report.json["representations"].push_back(toJson(result, measured->sets));
  report.text = fmt::format("{}x{}, {} threads, {} rays per pixel of the truth\n{}", bench.width,
                            bench.height, runner->threads(), bench.truthSamples, costTable(*measured));
  for (std::size_t s = 0; s < measured->sets.size(); ++s)
    if (!measured->sets[s].views.empty()) report.text += qualityTable(*measured, s);
  const auto json = options.output / "representations.json", table = options.output / "representations.txt";
  if (Status written = writeTextAtomically(json, jsonText(report.json, 2) + "\n"); !written)
    return tl::unexpected(written.error());
  if (Status written = writeTextAtomically(table, report.text); !written)
    return tl::unexpected(written.error());
  report.text += fmt::format("wrote {} and {}\n", json.string(), table.string());
  return report;
}

}  // namespace acentric::cli
