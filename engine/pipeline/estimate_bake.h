#pragma once
/// The estimate of a project's bake (engine/inspect/estimates.h), wired to the bake's own tracer and the
/// store's own writers. Nothing of it stays on disk.

#include "engine/inspect/estimates.h"
#include "engine/pipeline/pipeline.h"

namespace acentric {

/// `cameras`: empty = all; else indices. Traces with `runner`, so the estimate is for as many threads. Trial
/// files are written beside the project if that folder allows it, else where the system keeps temporary ones.
Result<BakeEstimate> estimateProjectBake(const OpenProject& open, const std::vector<int>& cameras,
                                         const EstimateOptions& options, TaskRunner& runner,
                                         const Progress& progress = {}, std::stop_token stop = {});

}  // namespace acentric
