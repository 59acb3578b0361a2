#include <fmt/format.h>

#include "engine/cli/commands.h"
#include "engine/pipeline/check_store.h"

namespace acentric::cli {

namespace {

Result<Report> validateStorey(const OpenProject& open, const Common& common) {
  const auto check = checkStore(open, *common.runner(), common.progress, common.stop);
  if (!check) return tl::unexpected(check.error());
  Report report;
  report.success = check->problems.empty();
  report.json = {{"project", open.file.string()},
                 {"valid", check->problems.empty()},
                 {"problems", check->problems},
                 {"capturesChecked", check->captures},
                 {"capturesMissing", check->capturesMissing},
                 {"simplifiedChecked", check->simplified},
                 {"simplifiedMissing", check->simplifiedMissing}};
  report.text =
      fmt::format("{}{}: project, scene and layout are sound; {} captures checked, {} not baked\n",
                  open.file.string(), storeyText(open.project), check->captures, check->capturesMissing);
  if (open.project.budget.simplifies())
    report.text += fmt::format(
        "regions above the budget: {} simplified ones checked, {} not simplified yet (the next walk, or "
        "acentric fit --simplify, does it)\n",
        check->simplified, check->simplifiedMissing);
  for (const std::string& problem : check->problems) report.text += "  problem: " + problem + "\n";
  return report;
}

}  // namespace

Result<Report> runValidate(const ValidateOptions& options, const Common& common) {
  const auto storeys = openStoreys(options.project, common);
  if (!storeys) return tl::unexpected(storeys.error());
  std::vector<Report> reports;
  for (const OpenProject& open : *storeys) {
    auto report = validateStorey(open, common);
    if (!report) return report;
    reports.push_back(std::move(*report));
  }
  return byStorey(*storeys, std::move(reports));
}

}  // namespace acentric::cli
