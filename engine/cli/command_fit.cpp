#include <fmt/format.h>

#include <algorithm>
#include <mutex>

#include "engine/cli/commands.h"
#include "engine/cli/region_report.h"
#include "engine/inspect/budget_picture.h"
#include "engine/inspect/fit.h"
#include "engine/pipeline/simplified_regions.h"

namespace acentric::cli {
namespace {

/// Turns and places that --rotate and --shift try.
constexpr int kRotations = 6, kOrigins = 3;

Json toJson(const FitPoint& point) {
  return {{"cellSize", point.cellSize},
          {"rotationDegrees", degrees(point.rotationRadians)},
          {"latticeOrigin", {point.latticeOrigin.x, point.latticeOrigin.y}},
          {"most", point.worst},
          {"median", point.median},
          {"over", point.over},
          {"regions", point.regions},
          {"cameras", point.cameras}};
}

std::string curveText(const FitResult& fitted) {
  std::string text = "  cell m      most    median  over  regions  cameras\n";
  for (const FitPoint& p : fitted.curve)
    text += fmt::format("{} {:6.3f} {:>9} {:>9} {:>5} {:>8} {:>8}\n",
                        p.cellSize == fitted.spec.cellSize ? '>' : ' ', p.cellSize, countText(p.worst),
                        countText(p.median), p.over, p.regions, p.cameras);
  return text;
}

std::string summary(const FitResult& fitted, std::size_t most) {
  if (fitted.satisfied)
    return fmt::format(
        "cells of {:g} m, turned by {:g} degrees: every region keeps to {} triangles (most: {})\n",
        fitted.spec.cellSize, degrees(fitted.spec.rotationRadians), countText(most),
        countText(fitted.budgets.worst()));
  return fmt::format(
      "no cells down to {:g} m keep every region to {} triangles; the best are of {:g} m: {} of {} "
      "regions exceed it, the worst has {}\n",
      fitted.leastTried, countText(most), fitted.spec.cellSize, fitted.over.size(),
      fitted.budgets.triangles.size(), countText(fitted.budgets.worst()));
}

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

/// Simplifies the regions above the budget of `open`'s project and puts them into its store.
Status simplifyRegions(const OpenProject& open, const RegionBudgets& budgets, const Common& common,
                       TaskRunner& runner, Report& report) {
  const auto store = CaptureStore::open(captureFolderFor(open.file));
  if (!store) return tl::unexpected(store.error());
  std::shared_ptr<const SurfaceLight> light;
  if (store->hasSurfaceLight(open.surfaceLightKey))
    if (auto baked = store->getSurfaceLight(open.surfaceLightKey))
      light = std::make_shared<const SurfaceLight>(std::move(*baked));
  const std::vector<int> over = budgets.over(std::size_t(open.project.budget.trianglesPerRegion));
  std::vector<Result<SimplifiedRegion>> made(over.size(), SimplifiedRegion{});
  std::mutex mutex;
  double done = 0;
  runner.parallelFor(over.size(), [&](std::size_t n) {
    const Region& region = open.layout->regions[std::size_t(over[n])];
    const auto full = std::make_shared<const LocalGeometry>(clipToPolygon(*open.scene, region.grown));
    made[n] = simplifiedRegion(open, over[n], full, light, *store, common.stop);
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
    Json json = cli::toJson(open.layout->regions[std::size_t(over[n])]);
    json["fromStore"] = made[n]->fromStore;
    json["report"] = toJson(r);
    report.json["simplified"].push_back(std::move(json));
    report.text += fmt::format(
        "  {}: {} -> {} triangles{}, {:.3g} mm at most, {:.3g} mm mean{}; PSNR {:.1f} dB, {:.2f} codes "
        "mean{}\n",
        placeText(open.layout->regions[std::size_t(over[n])]), countText(r.before), countText(r.after),
        r.withinBudget ? "" : " (above the budget)", 1e3 * r.maxError, 1e3 * r.meanError,
        r.withinError ? "" : " (beyond the error)", r.psnr, r.meanDifference,
        made[n]->fromStore ? " (from the store)" : fmt::format(" ({:.1f} s)", r.seconds));
    report.success = report.success && r.withinBudget && r.withinError;
  }
  return {};
}

}  // namespace

Result<Report> runFit(const FitCommandOptions& options, const Common& common) {
  const auto open = openProject(options.project, common.host, common.progress, common.stop);
  if (!open) return tl::unexpected(open.error());
  const auto runner = common.runner();
  FitOptions fitting;
  fitting.mostTriangles = options.most;
  fitting.leastCell = options.leastCell;
  fitting.rotations = options.rotate ? kRotations : 1;
  fitting.origins = options.shift ? kOrigins : 1;
  const TriangleTree tree(open->scene);
  const auto fitted = fitToBudget(open->project.layout, tree, fitting, *runner, common.progress, common.stop);
  if (!fitted) return tl::unexpected(fitted.error());
  const auto layout = buildLayout(fitted->spec);
  if (!layout) return tl::unexpected(layout.error());

  Report report;
  report.text = curveText(*fitted) + summary(*fitted, options.most);
  report.json = {{"project", options.project.string()},
                 {"limit", options.most},
                 {"satisfied", fitted->satisfied},
                 {"cellSize", fitted->spec.cellSize},
                 {"rotationDegrees", degrees(fitted->spec.rotationRadians)},
                 {"latticeOrigin", {fitted->spec.latticeOrigin.x, fitted->spec.latticeOrigin.y}},
                 {"most", fitted->budgets.worst()},
                 {"median", fitted->budgets.median()},
                 {"leastTried", fitted->leastTried},
                 {"droppedEdits", fitted->droppedEdits},
                 {"over", Json::array()},
                 {"curve", Json::array()}};
  for (const FitPoint& point : fitted->curve) report.json["curve"].push_back(toJson(point));
  for (const int r : fitted->over) {
    Json json = cli::toJson(layout->regions[std::size_t(r)]);
    json["triangles"] = fitted->budgets.triangles[std::size_t(r)];
    report.json["over"].push_back(std::move(json));
  }
  if (fitted->droppedEdits > 0)
    report.text += fmt::format("{} cells chosen one by one are left out: their addresses mean other places\n",
                               fitted->droppedEdits);
  if (!options.output.empty()) {
    const PlanPicture picture =
        pictureOf(*layout, fitted->budgets, options.most, open->scene->name + ": cells fitted to a budget");
    if (auto written = writePlanPicture(picture, options.output); !written)
      return tl::unexpected(written.error());
    report.json["picture"] = options.output.string();
    report.text += fmt::format("wrote {}\n", options.output.string());
  }
  report.success = fitted->satisfied;
  Project project = open->project;
  if (fitted->satisfied) {
    project.layout = fitted->spec;
  } else if (options.simplify) {
    // No cells fit: they stay as they are, and what exceeds the budget is simplified.
    report.success = true;
    project.budget = {int(std::min<std::size_t>(options.most, 2'000'000'000)), options.maxError, true};
    const auto simplifying = reopenProject(*open, project, common.host, common.progress, common.stop);
    if (!simplifying) return tl::unexpected(simplifying.error());
    const auto budgets = countRegions(tree, *simplifying->layout, *runner, {}, common.stop);
    if (!budgets) return tl::unexpected(budgets.error());
    if (auto done = simplifyRegions(*simplifying, *budgets, common, *runner, report); !done)
      return tl::unexpected(done.error());
  }
  report.json["applied"] = options.apply;
  if (options.apply) {
    if (!fitted->satisfied && !options.simplify)
      return fail(
          ErrorKind::invalidArgument,
          summary(*fitted, options.most) +
              "nothing was written: allow more with --max, smaller cells with --min-cell, or --simplify",
          options.project.string());
    if (auto saved = saveProject(project, options.project); !saved) return tl::unexpected(saved.error());
    report.text += fmt::format("wrote {}{}\n", options.project.string(),
                               fitted->satisfied ? ": what its cameras need is to be baked anew" : "");
  }
  return report;
}

}  // namespace acentric::cli
