#include <fmt/format.h>

#include <cmath>

#include "engine/cli/commands.h"
#include "engine/cli/fit_report.h"
#include "engine/cli/region_report.h"
#include "engine/inspect/refine.h"

namespace acentric::cli {
namespace {

const char* reasonOf(WhyOver why) {
  switch (why) {
    case WhyOver::smallest:
      return "smallest";
    case WhyOver::splitsNoHelp:
      return "splitsNoHelp";
    case WhyOver::freeApv:
      return "freeApv";
    case WhyOver::tooMany:
      return "tooMany";
  }
  return "smallest";
}

std::string textOf(const RefineResult& refined, const Layout& layout, std::size_t most) {
  std::string text = fmt::format(
      "before   {} regions, {} above {} triangles, the worst has {}\n"
      "after    {} regions, {} above, the worst has {}; {} split, {} merged, {} counted\n",
      countText(refined.regionsBefore), countText(refined.overBefore), countText(most),
      countText(refined.worstBefore), countText(layout.regions.size()), countText(refined.over.size()),
      countText(refined.budgets.worst()), countText(refined.split), countText(refined.merged),
      countText(refined.budgets.counted));
  for (std::size_t level = 0; level < refined.regionsPerLevel.size(); ++level)
    text += fmt::format("level {}  {} regions of {:g} m\n", level, countText(refined.regionsPerLevel[level]),
                        std::ldexp(layout.spec.cellSize, -int(level)));
  for (const RefineResult::Over& over : refined.over) {
    const auto r = std::size_t(over.region);
    text += fmt::format("  {:>9} triangles  {}: {}\n", countText(refined.budgets.triangles[r]),
                        placeText(layout.regions[r]), describe(over.why));
  }
  return text;
}

Json toJson(const RefineResult& refined, const Layout& layout, const FitCommandOptions& options) {
  Json json = {{"project", options.project.string()},
               {"limit", options.most},
               {"satisfied", refined.satisfied()},
               {"regionsBefore", refined.regionsBefore},
               {"overBefore", refined.overBefore},
               {"mostBefore", refined.worstBefore},
               {"regions", layout.regions.size()},
               {"cameras", layout.cameras.size()},
               {"most", refined.budgets.worst()},
               {"median", refined.budgets.median()},
               {"counted", refined.budgets.counted},
               {"split", refined.split},
               {"merged", refined.merged},
               {"regionsPerLevel", refined.regionsPerLevel},
               {"over", Json::array()}};
  for (const RefineResult::Over& over : refined.over) {
    Json region = cli::toJson(layout.regions[std::size_t(over.region)]);
    region["triangles"] = refined.budgets.triangles[std::size_t(over.region)];
    region["why"] = reasonOf(over.why);
    json["over"].push_back(std::move(region));
  }
  return json;
}

}  // namespace

Result<Report> runFitBySplitting(const FitCommandOptions& options, const Common& common) {
  const auto open = openChosen(options.project, common);
  if (!open) return tl::unexpected(open.error());
  const auto runner = common.runner();
  RefineOptions refining;
  refining.mostTriangles = options.most;
  refining.leastCell = options.leastCell;
  refining.merge = options.merge;
  const TriangleTree tree(open->scene);
  const auto refined =
      refineToBudget(open->project.layout(), tree, refining, *runner, common.progress, common.stop);
  if (!refined) return fail(refined.error().kind, refined.error().message, options.project.string());
  const auto layout = buildLayout(refined->spec);
  if (!layout) return tl::unexpected(layout.error());

  Report report;
  report.json = toJson(*refined, *layout, options);
  report.text = textOf(*refined, *layout, options.most);
  report.success = refined->satisfied();
  if (!options.output.empty())
    if (auto written =
            writeFitPicture(*layout, refined->budgets, options.most,
                            open->scene->name + ": cells split to keep to a budget", options.output, report);
        !written)
      return tl::unexpected(written.error());
  Project project = open->project;
  project.layout() = refined->spec;
  if (!refined->satisfied() && options.simplify) {
    project.budget = simplifyingBudget(options);
    if (auto done = simplifyRegions(*open, project, tree, common, *runner, report); !done)
      return tl::unexpected(done.error());
  }
  report.json["applied"] = options.apply;
  if (!options.apply) return report;
  if (!refined->satisfied() && !options.simplify)
    return fail(
        ErrorKind::invalidArgument,
        report.text +
            "nothing was written: allow more with --max, smaller cells with --min-cell, or --simplify",
        options.project.string());
  if (auto saved = saveEdited(project, options.project); !saved) return tl::unexpected(saved.error());
  report.text +=
      fmt::format("wrote {}{}\n", options.project.string(),
                  refined->split + refined->merged > 0 ? ": what its cameras need is to be baked anew" : "");
  return report;
}

}  // namespace acentric::cli
