#pragma once
/// acentric coverage --pruning: what pruning loses, what less would take, and who sees what is lost.

#include "engine/cli/command.h"

namespace acentric::cli {

Result<Report> lossesOfPruning(const std::filesystem::path& project, const Common& common);

}  // namespace acentric::cli
