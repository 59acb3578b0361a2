#include <fmt/format.h>

#include <algorithm>

#include "engine/cli/commands.h"
#include "engine/picture/chart.h"
#include "engine/picture/drawing.h"

namespace acentric::cli {
namespace {

struct Growth {
  double triangles = 0;
  Json bench;  ///< as runBench reports it
};

double medianOf(const Growth& growth, std::size_t renderer) {
  return growth.bench["renderers"][renderer]["frameMs"]["median"].get<double>();
}

Chart chartOf(const std::vector<Growth>& all, const std::vector<std::string>& renderers) {
  const Json& first = all.front().bench;
  Chart chart;
  chart.title = "Time of a frame as the scene grows";
  chart.subtitle = fmt::format("{}x{} pixels, {}, {} threads; medians of {} frames",
                               first["width"].get<int>(), first["height"].get<int>(),
                               first["processor"].get<std::string>(), first["threads"].get<int>(),
                               first["frames"].get<std::size_t>() * first["repeats"].get<std::size_t>());
  chart.across = "triangles of the scene";
  chart.up = "milliseconds a frame";
  for (std::size_t r = 0; r < renderers.size(); ++r) {
    ChartLine line{renderers[r] == "truth"  ? "ray tracing"
                   : renderers[r] == "list" ? "walk (list)"
                                            : renderers[r],
                   {}};
    for (const Growth& g : all) line.points.emplace_back(g.triangles, medianOf(g, r));
    chart.lines.push_back(std::move(line));
  }
  return chart;
}

}  // namespace

Result<Report> runBenchGrowth(const BenchGrowthOptions& options, const Common& common) {
  if (!options.chart.empty())
    if (Status possible = checkDrawingPath(options.chart); !possible) return tl::unexpected(possible.error());
  std::vector<Growth> all;
  for (const std::filesystem::path& project : options.projects) {
    BenchOptions view = options.view;
    view.project = project;
    auto report = runBench(view, common);
    if (!report) return tl::unexpected(report.error());
    all.push_back({report->json["triangles"].get<double>(), std::move(report->json)});
  }
  std::ranges::sort(all, {}, &Growth::triangles);
  const std::vector<std::string>& renderers = options.view.renderers;
  Report report;
  report.json = {{"projects", Json::array()}, {"spread", Json::object()}};
  report.text = fmt::format("{:>12}", "triangles");
  for (const std::string& name : renderers) report.text += fmt::format(" {:>14}", name + " ms");
  report.text += "\n";
  for (const Growth& g : all) {
    report.text += fmt::format("{:>12.0f}", g.triangles);
    for (std::size_t r = 0; r < renderers.size(); ++r)
      report.text += fmt::format(" {:>14.2f}", medianOf(g, r));
    report.text += "\n";
    report.json["projects"].push_back(g.bench);
  }
  for (std::size_t r = 0; r < renderers.size(); ++r) {
    const auto [least, most] = std::ranges::minmax(all, {}, [&](const Growth& g) { return medianOf(g, r); });
    const double grown = medianOf(most, r) / medianOf(least, r);
    report.json["spread"][renderers[r]] = grown;
    report.text +=
        fmt::format("  {}: the slowest takes {:.2f} times as long as the fastest\n", renderers[r], grown);
  }
  if (!options.chart.empty())
    if (Status written = writeChart(chartOf(all, renderers), options.chart); !written)
      return tl::unexpected(written.error());
  return report;
}

}  // namespace acentric::cli
