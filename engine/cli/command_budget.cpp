#include <fmt/format.h>

#include "engine/cli/commands.h"
#include "engine/cli/region_report.h"
#include "engine/inspect/budget_picture.h"

namespace acentric::cli {
namespace {

constexpr std::size_t kWorstShown = 8;

Json toJson(const Region& region, std::size_t triangles) {
  Json json = cli::toJson(region);
  json["triangles"] = triangles;
  return json;
}

}  // namespace

Result<Report> runBudget(const BudgetOptions& options, const Common& common) {
  const auto open = openChosen(options.project, common);
  if (!open) return tl::unexpected(open.error());
  const Layout& layout = *open->layout;
  const auto runner = common.runner();
  BudgetCounter counter(open->scene);
  const auto budgets = counter.count(layout, *runner, common.progress, common.stop);
  if (!budgets) return tl::unexpected(budgets.error());
  std::optional<std::size_t> limit;
  if (open->project.budget.trianglesPerRegion > 0)
    limit = std::size_t(open->project.budget.trianglesPerRegion);
  if (options.most > 0) limit = options.most;

  Json regions = Json::array();
  for (std::size_t r = 0; r < layout.regions.size(); ++r)
    regions.push_back(toJson(layout.regions[r], budgets->triangles[r]));
  Report report;
  report.json = {{"project", options.project.string()},
                 {"regions", std::move(regions)},
                 {"median", budgets->median()},
                 {"most", budgets->worst()}};
  report.text = fmt::format("{} regions; triangles per region: {} (median), {} (most)\n",
                            layout.regions.size(), countText(budgets->median()), countText(budgets->worst()));
  const std::vector<int> worst = budgets->over(limit.value_or(0));
  if (limit) {
    report.json["limit"] = *limit;
    report.json["over"] = Json::array();
    for (const int r : worst)
      report.json["over"].push_back(
          toJson(layout.regions[std::size_t(r)], budgets->triangles[std::size_t(r)]));
    report.text += fmt::format("{} of {} regions exceed {} triangles\n", worst.size(), layout.regions.size(),
                               countText(*limit));
  }
  const std::size_t shown = limit ? worst.size() : std::min(worst.size(), kWorstShown);
  if (!limit && shown > 0) report.text += "the largest:\n";
  for (std::size_t n = 0; n < shown; ++n) {
    const auto r = static_cast<std::size_t>(worst[n]);
    report.text += fmt::format("  {:>9} triangles  {}\n", countText(budgets->triangles[r]),
                               placeText(layout.regions[r]));
  }
  if (!options.output.empty()) {
    const PlanPicture picture =
        pictureOf(layout, *budgets, limit, open->scene->name + ": triangles of local geometry");
    if (auto written = writePlanPicture(picture, options.output); !written)
      return tl::unexpected(written.error());
    report.json["picture"] = options.output.string();
    report.text += fmt::format("wrote {}\n", options.output.string());
  }
  return report;
}

}  // namespace acentric::cli
