#pragma once
/// A project as a bundle for runtimes (engine/export/FORMAT.md).

#include <optional>

#include "engine/export/bundle_write.h"
#include "engine/pipeline/pipeline.h"

namespace acentric {

struct ExportBundleOptions {
  bool allowMissing = false;  ///< write what there is; else captures or light that are not baked are refused
  std::string generator;      ///< program and version, for the index
  std::optional<int> colourQuality;  ///< 0..100 (colour_quality.h); none: the project's
};

/// `storeys`: all of one project, in order, as openStoreys gives them.
Result<BundleReport> exportBundle(std::span<const OpenProject> storeys, const std::filesystem::path& folder,
                                  const ExportBundleOptions& options, TaskRunner& runner,
                                  const Progress& progress = {}, std::stop_token stop = {});

}  // namespace acentric
