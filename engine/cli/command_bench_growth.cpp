#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "engine/cli/commands.h"
#include "engine/picture/chart.h"
#include "engine/picture/drawing.h"

namespace acentric::cli {
namespace {

struct Growth {
  double triangles = 0;
  Json bench;  ///< as runBench reports it
};

/// Milliseconds of a frame; nothing where the renderer was left out.
std::optional<double> medianOf(const Growth& growth, const std::string& renderer, bool processorTime) {
  for (const Json& each : growth.bench["renderers"])
    if (each["renderer"] == renderer)
      return each[processorTime ? "processorMs" : "frameMs"]["median"].get<double>();
  return {};
}

std::string lineName(const std::string& renderer) {
  return renderer == "truth" ? "ray tracing" : renderer == "list" ? "walk (list)" : renderer;
}

/// "polygons cannot hold the scenes of 100 M and more", or nothing.
std::string leftOutText(const std::vector<Growth>& all, const std::vector<std::string>& renderers) {
  std::string text;
  for (const Growth& g : all)
    for (const Json& each : g.bench["leftOut"]) {
      const auto name = each["renderer"].get<std::string>();
      if (std::ranges::find(renderers, name) == renderers.end() || text.find(name + " ") != std::string::npos)
        continue;
      text += fmt::format("{}{} cannot hold {} triangles", text.empty() ? "" : ", ", name,
                          countText(std::uint64_t(g.triangles)));
    }
  return text;
}

Chart chartOf(const std::vector<Growth>& all, const std::vector<std::string>& renderers, bool processorTime) {
  const Json& first = all.front().bench;
  Chart chart;
  chart.title = "Time of a frame as the scene grows";
  chart.subtitle = fmt::format("{}x{} pixels, {}, {} threads; medians of {} frames",
                               first["width"].get<int>(), first["height"].get<int>(),
                               first["processor"].get<std::string>(), first["threads"].get<int>(),
                               first["frames"].get<std::size_t>() * first["repeats"].get<std::size_t>());
  chart.note = leftOutText(all, renderers);
  chart.across = "triangles of the scene";
  chart.up = processorTime ? "milliseconds of processor time a frame" : "milliseconds a frame";
  for (const std::string& renderer : renderers) {
    ChartLine line{lineName(renderer), {}};
    for (const Growth& g : all)
      if (const auto median = medianOf(g, renderer, processorTime))
        line.points.emplace_back(g.triangles, *median);
    if (!line.points.empty()) chart.lines.push_back(std::move(line));
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
    view.leaveOut = true;
    auto report = runBench(view, common);
    if (!report) return tl::unexpected(report.error());
    all.push_back({report->json["triangles"].get<double>(), std::move(report->json)});
  }
  std::ranges::sort(all, {}, &Growth::triangles);
  const std::vector<std::string>& renderers = options.view.renderers;
  Report report;
  report.json = {{"projects", Json::array()}, {"spread", Json::object()}};
  report.text = fmt::format("{:>14}", "triangles");
  for (const std::string& name : renderers) report.text += fmt::format(" {:>14}", name + " ms");
  report.text += options.processorTime ? "  (processor time)\n" : "\n";
  for (const Growth& g : all) {
    report.text += fmt::format("{:>14.0f}", g.triangles);
    for (const std::string& name : renderers) {
      const auto median = medianOf(g, name, options.processorTime);
      report.text += median ? fmt::format(" {:>14.2f}", *median) : fmt::format(" {:>14}", "left out");
    }
    report.text += "\n";
    report.json["projects"].push_back(g.bench);
  }
  for (const std::string& name : renderers) {
    std::vector<double> medians;
    for (const Growth& g : all)
      if (const auto median = medianOf(g, name, options.processorTime)) medians.push_back(*median);
    if (medians.empty()) continue;
    const auto [least, most] = std::ranges::minmax(medians);
    report.json["spread"][name] = most / least;
    report.text +=
        fmt::format("  {}: the slowest takes {:.2f} times as long as the fastest\n", name, most / least);
  }
  if (const std::string left = leftOutText(all, renderers); !left.empty()) report.text += "  " + left + "\n";
  if (!options.chart.empty())
    if (Status written = writeChart(chartOf(all, renderers, options.processorTime), options.chart); !written)
      return tl::unexpected(written.error());
  return report;
}

}  // namespace acentric::cli
