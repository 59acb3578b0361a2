#include <fmt/format.h>

#include "engine/cli/commands.h"
#include "engine/pipeline/check_store.h"

namespace acentric::cli {

Result<Report> runValidate(const ValidateOptions& options, const Common& common) {
  const auto open = openProject(options.project, common.host, common.progress, common.stop);
  if (!open) return tl::unexpected(open.error());
  const auto check = checkStore(*open, *common.runner(), common.progress, common.stop);
  if (!check) return tl::unexpected(check.error());
  Report report;
  report.success = check->problems.empty();
  report.json = {{"project", options.project.string()},
                 {"valid", check->problems.empty()},
                 {"problems", check->problems},
                 {"capturesChecked", check->captures},
                 {"capturesMissing", check->capturesMissing},
                 {"simplifiedChecked", check->simplified},
                 {"simplifiedMissing", check->simplifiedMissing}};
  report.text = fmt::format("{}: project, scene and layout are sound; {} captures checked, {} not baked\n",
                            options.project.string(), check->captures, check->capturesMissing);
  if (open->project.budget.simplifies())
    report.text += fmt::format(
        "regions above the budget: {} simplified ones checked, {} not simplified yet (the next walk, or "
        "acentric fit --simplify, does it)\n",
        check->simplified, check->simplifiedMissing);
  for (const std::string& problem : check->problems) report.text += "  problem: " + problem + "\n";
  return report;
}

}  // namespace acentric::cli
