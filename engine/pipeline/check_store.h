#pragma once
/// Reads all that a project has on disk to its end: captures, surface light and simplified regions. Changes
/// nothing.

#include <stop_token>
#include <string>
#include <vector>

#include "engine/pipeline/pipeline.h"

namespace acentric {

struct StoreCheck {
  std::size_t captures = 0, capturesMissing = 0;
  /// Of regions above the budget, where the project simplifies them.
  std::size_t simplified = 0, simplifiedMissing = 0;
  std::vector<std::string> problems;  ///< each names its file
};

Result<StoreCheck> checkStore(const OpenProject& open, TaskRunner& runner, const Progress& progress = {},
                              std::stop_token stop = {});

}  // namespace acentric
