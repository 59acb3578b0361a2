#pragma once
/// Reads to its end all that a walk or a bake of a project would read of its captures' folder: captures
/// (where there is none of full quality, the best there is), surface light, records, simplified regions. Each
/// file is compared with the checksum in it and with what its record says of it. Files stay as they are.

#include <stop_token>
#include <string>
#include <vector>

#include "engine/pipeline/pipeline.h"

namespace acentric {

struct StoreCheck {
  std::size_t captures = 0, capturesMissing = 0;
  std::size_t coarse = 0;  ///< of the missing ones: those of which a preview or a draft was checked
  /// Of captures and light: their files are checked by their own checksums alone.
  std::size_t withoutRecord = 0;
  bool surfaceLightMissing = false;
  /// Of regions above the budget, where the project simplifies them.
  std::size_t simplified = 0, simplifiedMissing = 0;
  std::vector<std::string> problems;  ///< each names its file
};

Result<StoreCheck> checkStore(const OpenProject& open, TaskRunner& runner, const Progress& progress = {},
                              std::stop_token stop = {});

}  // namespace acentric
