#pragma once
/// What both ways to fit a layout to a budget share: the picture, and the simplification of regions that
/// still exceed it.

#include "engine/cli/commands.h"
#include "engine/inspect/budgets.h"

namespace acentric::cli {

Status writeFitPicture(const Layout& layout, const RegionBudgets& budgets, std::size_t most,
                       std::string title, const std::filesystem::path& output, Report& report);

/// The project's budget that `--simplify` asks for.
TriangleBudget simplifyingBudget(const FitCommandOptions& options);

/// Opens `project`, which has such a budget, in place of `open`'s, simplifies its regions above the budget
/// and puts them into its store. The report succeeds if all come within the budget and the error.
Status simplifyRegions(const OpenProject& open, const Project& project, const TriangleTree& tree,
                       const Common& common, TaskRunner& runner, Report& report);

}  // namespace acentric::cli
