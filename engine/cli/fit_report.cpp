#include "engine/cli/fit_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>

#include "engine/cli/region_report.h"
#include "engine/inspect/budget_picture.h"
#include "engine/pipeline/simplified_regions.h"

namespace acentric::cli {
namespace {

Json toJson(const SimplifyReport& r) {
  return {{"before", r.before},
          {"after", r.after},
          {"rim", r.rim},
          {"split", r.split},
          {"maxErrorMetres", r.maxError},
          {"meanErrorMetres", r.meanError},
          {"errorSamples", r.errorSamples},
          {"withinError", r.withinError},
          {"withinBudget", r.withinBudget},
          {"seconds", r.seconds},
          {"comparedFrames", r.comparedFrames},
          {"psnr", r.psnr},
          {"meanDifference", r.meanDifference}};
}

}  // namespace

Status writeFitPicture(const Layout& layout, const RegionBudgets& budgets, std::size_t most,
                       std::string title, const std::filesystem::path& output, Report& report) {
  if (auto written = writePlanPicture(pictureOf(layout, budgets, most, std::move(title)), output); !written)
    return written;
  report.json["picture"] = output.string();
  report.text += fmt::format("wrote {}\n", output.string());
  return {};
}

TriangleBudget simplifyingBudget(const FitCommandOptions& options) {
  return {int(std::min<std::size_t>(options.most, 2'000'000'000)), options.maxError, true};
}

Status simplifyRegions(const OpenProject& open, const Project& project, const TriangleTree& tree,
                       const Common& common, TaskRunner& runner, Report& report) {
  report.success = true;
  const auto simplifying = reopenProject(open, project, common.host, common.progress, common.stop);
  if (!simplifying) return tl::unexpected(simplifying.error());
  if (Status near = checkNear(simplifying->near); !near) return near;
  const auto budgets = countRegions(tree, *simplifying->layout, runner, {}, common.stop);
  if (!budgets) return tl::unexpected(budgets.error());
  const auto store = CaptureStore::open(captureFolderFor(simplifying->file));
  if (!store) return tl::unexpected(store.error());
  std::shared_ptr<const SurfaceLight> light;
  if (store->hasSurfaceLight(simplifying->surfaceLightKey))
    if (auto baked = store->getSurfaceLight(simplifying->surfaceLightKey))
      light = std::make_shared<const SurfaceLight>(std::move(*baked));
  const std::vector<int> over = budgets->over(std::size_t(simplifying->project.budget.trianglesPerRegion));
  std::vector<Result<SimplifiedRegion>> made(over.size(), SimplifiedRegion{});
  std::mutex mutex;
  double done = 0;
  runner.parallelFor(over.size(), [&](std::size_t n) {
    const Region& region = simplifying->layout->regions[std::size_t(over[n])];
    const auto full = std::make_shared<const LocalGeometry>(clipToPolygon(*simplifying->drawn, region.grown));
    made[n] = simplifiedRegion(*simplifying, over[n], full, light, *store, common.stop);
    const std::lock_guard lock(mutex);
    if (common.progress)
      common.progress({++done, double(over.size()), "simplifying regions above the budget"});
  });
  report.json["simplified"] = Json::array();
  report.json["lit"] = light != nullptr;
  report.text += fmt::format("simplified regions ({} light):\n", light ? "with baked" : "without baked");
  for (std::size_t n = 0; n < over.size(); ++n) {
    if (!made[n]) return tl::unexpected(made[n].error());
    const SimplifyReport& r = made[n]->report;
    Json json = cli::toJson(simplifying->layout->regions[std::size_t(over[n])]);
    json["fromStore"] = made[n]->fromStore;
    json["report"] = toJson(r);
    report.json["simplified"].push_back(std::move(json));
    report.text += fmt::format(
        "  {}: {} -> {} triangles{}, {:.3g} mm at most, {:.3g} mm mean{}; PSNR {:.1f} dB, {:.2f} codes "
        "mean{}\n",
        placeText(simplifying->layout->regions[std::size_t(over[n])]), countText(r.before),
        countText(r.after), r.withinBudget ? "" : " (above the budget)", 1e3 * r.maxError, 1e3 * r.meanError,
        r.withinError ? "" : " (beyond the error)", r.psnr, r.meanDifference,
        made[n]->fromStore ? " (from the store)" : fmt::format(" ({:.1f} s)", r.seconds));
    report.success = report.success && r.withinBudget && r.withinError;
  }
  return {};
}

}  // namespace acentric::cli
