#pragma once
/// What `acentric bake` was asked for, of each storey; and what of it would be done, and why.

#include <vector>

#include "engine/cli/commands.h"
#include "engine/pipeline/bake_plan.h"
#include "engine/pipeline/shard.h"

namespace acentric::cli {

/// Of each of the plan's storeys; its cameras are always listed.
std::vector<BakeRequest> bakeRequests(const BakePlan& plan, const BakeOptions& options, const Shard& shard);

/// Is there nothing left to do, nor to note?
bool allDone(const std::vector<BakeRequest>& requests, const std::vector<StoreyState>& states);

/// Opens the plan's storeys, unless they are open.
Status openStoreysOf(BakePlan& plan, const Common& common);

Result<Report> dryRun(BakePlan& plan, const std::vector<BakeRequest>& requests, const Common& common);

}  // namespace acentric::cli
