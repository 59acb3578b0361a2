#include <fmt/format.h>

#include <algorithm>

#include "engine/cli/commands.h"
#include "engine/cli/fit_report.h"
#include "engine/cli/region_report.h"
#include "engine/inspect/fit.h"

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

}  // namespace

Result<Report> runFit(const FitCommandOptions& options, const Common& common) {
  if (options.split) return runFitBySplitting(options, common);
  const auto open = openChosen(options.project, common);
  if (!open) return tl::unexpected(open.error());
  const auto runner = common.runner();
  FitOptions fitting;
  fitting.mostTriangles = options.most;
  fitting.leastCell = options.leastCell;
  fitting.rotations = options.rotate ? kRotations : 1;
  fitting.origins = options.shift ? kOrigins : 1;
  const TriangleTree tree(open->scene);
  const auto fitted =
      fitToBudget(open->project.layout(), tree, fitting, *runner, common.progress, common.stop);
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
  if (!options.output.empty())
    if (auto written =
            writeFitPicture(*layout, fitted->budgets, options.most,
                            open->scene->name + ": cells fitted to a budget", options.output, report);
        !written)
      return tl::unexpected(written.error());
  report.success = fitted->satisfied;
  Project project = open->project;
  if (fitted->satisfied) {
    project.layout() = fitted->spec;
  } else if (options.simplify) {
    // No cells fit: they stay as they are, and what exceeds the budget is simplified.
    project.budget = simplifyingBudget(options);
    if (auto done = simplifyRegions(*open, project, tree, common, *runner, report); !done)
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
    if (auto saved = saveEdited(project, options.project); !saved) return tl::unexpected(saved.error());
    report.text += fmt::format("wrote {}{}\n", options.project.string(),
                               fitted->satisfied ? ": what its cameras need is to be baked anew" : "");
  }
  return report;
}

}  // namespace acentric::cli
