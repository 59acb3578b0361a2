#include <fmt/format.h>

#include <algorithm>

#include "engine/base/file.h"
#include "engine/base/json_text.h"
#include "engine/bench/holes.h"
#include "engine/cli/bake_notice.h"
#include "engine/cli/commands.h"
#include "engine/cli/machine/machine.h"
#include "engine/geometry/conventions.h"
#include "engine/measure/source_colours.h"
#include "engine/measure/statistics.h"
#include "engine/picture/captioned_pictures.h"

namespace acentric::cli {
namespace {

constexpr int kPictureWidth = 240;
constexpr std::size_t kMostRows = 8;

struct Spreads {
  Spread holes, open, psnr, ssim;
  explicit Spreads(const HoleBenchMethod& method)
      : holes(of(method, &Comparison::holeShare)),
        open(spreadOf(method.openShares)),
        psnr(of(method, &Comparison::psnr)),
        ssim(of(method, &Comparison::ssim)) {}

 private:
  static Spread of(const HoleBenchMethod& method, double Comparison::*value) {
    std::vector<double> values;
    for (const Comparison& comparison : method.comparisons) values.push_back(comparison.*value);
    return spreadOf(std::move(values));
  }
};

Json toJson(const HoleBenchMethod& method) {
  const Spreads s(method);
  Json frames = Json::array();
  for (const Comparison& c : method.comparisons)
    frames.push_back({{"holeShare", c.holeShare}, {"psnr", c.psnr}, {"ssim", c.ssim}});
  return {{"name", method.name},           {"description", method.description},
          {"samples", method.samples},     {"holeShareMedian", s.holes.median},
          {"holeShareWorst", s.holes.max}, {"psnrMedian", s.psnr.median},
          {"psnrWorst", s.psnr.min},       {"ssimMedian", s.ssim.median},
          {"ssimWorst", s.ssim.min},       {"frames", std::move(frames)}};
}

std::string tableOf(const HoleBench& bench) {
  std::string table = fmt::format("  {:<15} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8} {:>8} {:>12}\n", "", "holes",
                                  "worst", "open", "PSNR", "worst", "SSIM", "worst", "samples");
  for (const HoleBenchMethod& method : bench.methods) {
    const Spreads s(method);
    table += fmt::format(
        "  {:<15} {:>7.3f} % {:>7.3f} % {:>7.3f} % {:>6.2f} dB {:>6.2f} dB {:>8.4f} {:>8.4f} {:>12}\n",
        method.name, 100 * s.holes.median, 100 * s.holes.max, 100 * s.open.median, s.psnr.median, s.psnr.min,
        s.ssim.median, s.ssim.min, countText(method.samples));
  }
  for (const HoleBenchMethod& method : bench.methods)
    table += fmt::format("  {}: {}\n", method.name, method.description);
  return table;
}

/// What nothing was painted on is made to be seen.
ColourImage holesShown(ColourImage picture) {
  for (Rgba8& pixel : picture.pixels)
    if (pixel.a == 0) pixel = kInventedColour;
  return picture;
}

Sheet sheetOf(const HoleBench& bench) {
  Sheet sheet;
  sheet.pictureWidth = std::min(kPictureWidth, bench.views.front().width);
  sheet.headings = {"ray-traced"};
  for (const HoleBenchMethod& method : bench.methods) sheet.headings.push_back(method.name);
  const std::size_t rows = std::min(bench.views.size(), kMostRows);
  for (std::size_t r = 0; r < rows; ++r) {
    const std::size_t v = rows == 1 ? 0 : r * (bench.views.size() - 1) / (rows - 1);
    const double way = glm::distance(bench.views[v].eye, bench.views.front().eye);
    SheetRow row{fmt::format("{:.2f} m", way), {{bench.truth[v], ""}}};
    for (const HoleBenchMethod& method : bench.methods)
      row.pictures.push_back({holesShown(method.pictures[v]),
                              fmt::format("{:.3f} % holes, {:.1f} dB", 100 * method.comparisons[v].holeShare,
                                          method.comparisons[v].psnr)});
    sheet.rows.push_back(std::move(row));
  }
  sheet.notes = {
      "Rows: from the centre of a ring to its left. What is open is magenta; the figures are "
      "of frames where it is filled."};
  return sheet;
}

}  // namespace

Result<Report> runBenchHoles(const BenchHolesOptions& options, const Common& common) {
  const auto size = parseSize(options.size);
  if (!size) return tl::unexpected(size.error());
  HoleBenchOptions bench;
  bench.frames = options.frames;
  bench.width = size->width, bench.height = size->height;
  bench.fovDegrees = options.fovDegrees;
  bench.truthSamples = options.truthSamples;
  bench.tell = tellerTo(common);
  if (!options.place.empty()) {
    const auto place = parsePoint(options.place);
    if (!place) return tl::unexpected(place.error());
    bench.place = *place;
  }
  if (options.yawDegrees) bench.yawRadians = radians(*options.yawDegrees);
  const auto open = openChosen(options.project, common);
  if (!open) return tl::unexpected(open.error());
  const auto runner = common.runner();
  const auto measured = benchHoles(*open, bench, *runner, common.progress, common.stop);
  if (!measured) return tl::unexpected(measured.error());

  const PerspectiveView& first = measured->views.front();
  Report report;
  report.json = measuredOn(runner->threads());
  report.json.update({{"project", options.project.string()},
                      {"region", {measured->region.i, measured->region.j, measured->region.slot}},
                      {"from", cli::toJson(first.eye)},
                      {"to", cli::toJson(measured->views.back().eye)},
                      {"yaw", degrees(first.yawRadians)},
                      {"fov", degrees(first.fovRadians)},
                      {"width", first.width},
                      {"height", first.height},
                      {"frames", measured->views.size()},
                      {"samplesPerDegree", open->project.bake.samplesPerDegree},
                      {"truthSamples", options.truthSamples},
                      {"methods", Json::array()}});
  for (const HoleBenchMethod& method : measured->methods) report.json["methods"].push_back(toJson(method));
  report.text = fmt::format(
      "{} frames of {}x{} from ({:.2f}, {:.2f}) to ({:.2f}, {:.2f}), {:g} samples per degree; medians and "
      "worst\n{}",
      measured->views.size(), first.width, first.height, first.eye.x, first.eye.y,
      measured->views.back().eye.x, measured->views.back().eye.y, open->project.bake.samplesPerDegree,
      tableOf(*measured));
  if (options.output.empty()) return report;

  const auto sheet = drawSheet(sheetOf(*measured));
  if (!sheet) return tl::unexpected(sheet.error());
  const auto picture = options.output / "holes.png", json = options.output / "holes.json",
             table = options.output / "holes.txt";
  if (Status written = writeColourImage(*sheet, picture); !written) return tl::unexpected(written.error());
  if (Status written = writeTextAtomically(json, jsonText(report.json, 2) + "\n"); !written)
    return tl::unexpected(written.error());
  if (Status written = writeTextAtomically(table, report.text); !written)
    return tl::unexpected(written.error());
  report.json["picture"] = picture.string();
  report.text += fmt::format("wrote {}, {} and {}\n", picture.string(), json.string(), table.string());
  return report;
}

}  // namespace acentric::cli
