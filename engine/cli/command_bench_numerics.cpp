/// acentric bench numerics: what careful arithmetic buys and costs.

#include <fmt/format.h>

#include "engine/base/file.h"
#include "engine/base/json_text.h"
#include "engine/bench/numerics.h"
#include "engine/cli/commands.h"
#include "engine/cli/machine/machine.h"
#include "engine/cli/path_frames.h"
#include "engine/measure/svg_plot.h"
#include "engine/measure/sweep_report.h"

namespace acentric::cli {
namespace {

Status writeFiles(const std::filesystem::path& folder, const Json& json, const Numerics& numerics,
                  const std::string& scene) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (Status written = writeTextAtomically(folder / "numerics.json", jsonText(json, 2) + "\n"); !written)
    return written;
  if (Status written = writeTextAtomically(folder / "numerics.csv", toCsv(numerics)); !written)
    return written;
  return writeTextAtomically(
      folder / "numerics.html",
      reportPage(
          "Numerical accuracy: " + scene,
          fmt::format("<h1>{}</h1>\n<p class=\"faint\">{}, {} threads &middot; Acentric {}, commit {}</p>\n",
                      htmlText(scene), htmlText(json.at("processor").get<std::string>()),
                      json.at("threads").get<int>(), htmlText(json.at("version").get<std::string>()),
                      htmlText(json.at("commit").get<std::string>())) +
              toHtml(numerics)));
}

}  // namespace

Result<Report> runBenchNumerics(const BenchNumericsOptions& options, const Common& common) {
  const auto walk =
      openAlong(options.project, options.path, options.size, 0, kTourFrames, common, Along::oneStorey);
  if (!walk) return tl::unexpected(walk.error());
  const OpenProject& open = walk->storeys.front();
  const auto views = evenly(walk->views, options.frames);
  const auto runner = common.runner();
  const auto numerics = benchNumerics(open, views, {options.repeats}, *runner, common.progress, common.stop);
  if (!numerics) return tl::unexpected(numerics.error());
  Report report;
  report.json = measuredOn(runner->threads());
  report.json.update({{"project", options.project.string()},
                      {"width", walk->size.width},
                      {"height", walk->size.height},
                      {"frames", views.size()},
                      {"repeats", options.repeats},
                      {"numerics", parseJson<Json>(toJson(*numerics)).value_or(Json())}});
  report.text =
      fmt::format("{}, {} threads, {}x{}, {} frames x {}\n{}", processorName(), runner->threads(),
                  walk->size.width, walk->size.height, views.size(), options.repeats, toText(*numerics));
  if (options.output.empty()) return report;
  if (Status written = writeFiles(options.output, report.json, *numerics, open.scene->name); !written)
    return tl::unexpected(written.error());
  report.text += fmt::format("wrote {}\n", (options.output / "numerics.html").string());
  return report;
}

}  // namespace acentric::cli
