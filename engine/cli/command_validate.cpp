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
                 {"coarseChecked", check->coarse},
                 {"surfaceLightMissing", check->surfaceLightMissing},
                 {"withoutRecord", check->withoutRecord},
                 {"simplifiedChecked", check->simplified},
                 {"simplifiedMissing", check->simplifiedMissing}};
  report.text = fmt::format(
      "{}{}: project, scene and layout are sound; {} captures checked, {} not baked, {} problem{}\n",
      open.file.string(), storeyText(open.project), check->captures, check->capturesMissing,
      check->problems.size(), check->problems.size() == 1 ? "" : "s");
  if (check->coarse > 0)
    report.text +=
        fmt::format("  of those not baked {} have a preview or a draft, checked too\n", check->coarse);
  if (check->surfaceLightMissing && check->captures > 0)
    report.text += "  the light on local geometry is not baked\n";
  if (check->withoutRecord > 0)
    report.text += fmt::format(
        "  {} have no record of their files, which were checked by their own checksums alone (acentric bake "
        "notes them)\n",
        check->withoutRecord);
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
