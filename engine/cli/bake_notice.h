#pragma once
/// What a bake will take, told before it begins.

#include "engine/cli/command.h"
#include "engine/pipeline/bake_forecast.h"

namespace acentric::cli {

Json toJson(const BakeForecast& forecast);

/// As a line of text, or as an event {"event": "bakeForecast", ...}.
void tell(const BakeForecast& forecast, const Common& common);

/// The same for a bench that bakes for itself; of nothing to bake it does not tell.
BakeTeller tellerTo(const Common& common);

/// Foretells briefly and tells; of a bake that has nothing to do neither.
Result<BakeForecast> foretellBake(std::span<const BakeShare> shares, std::size_t memoryBytes,
                                  const Common& common, TaskRunner& runner);

}  // namespace acentric::cli
