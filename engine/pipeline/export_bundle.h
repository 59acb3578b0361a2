#pragma once
/// A project as a bundle for runtimes (engine/export/FORMAT.md).

#include <optional>

#include "engine/export/bundle_write.h"
#include "engine/pipeline/pipeline.h"

namespace acentric {

struct ExportBundleOptions {
  bool allowMissing = false;  ///< write what there is; else captures or light that are not baked are refused
  std::string generator;      ///< program and version, for the index
  std::optional<int> colourQuality;   ///< 0..100 (colour_quality.h); none: the project's
  std::filesystem::path former = {};  ///< as in BundleInput
  int storey = 0;                     ///< where the walk begins
};

/// What is not baked of a project.
struct BakeGaps {
  std::size_t cameras = 0;  ///< in all
  std::size_t missing = 0;  ///< of these: without their full captures
  std::size_t empty = 0;    ///< of the missing: without a preview or draft too
  bool light = false;       ///< the light of near surfaces is missing, of a storey at least
  bool any() const { return missing > 0 || light; }
  bool all() const { return empty == cameras; }
  /// "3 of 12 captures and the light of near surfaces are not baked yet"; empty where all is.
  std::string describe() const;
};
Result<BakeGaps> bakeGaps(std::span<const OpenProject> storeys);

/// `storeys`: all of one project, in order, as openStoreys gives them.
Result<BundleReport> exportBundle(std::span<const OpenProject> storeys, const std::filesystem::path& folder,
                                  const ExportBundleOptions& options, TaskRunner& runner,
                                  const Progress& progress = {}, std::stop_token stop = {});

}  // namespace acentric
