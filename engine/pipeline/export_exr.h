#pragma once
/// What is baked as OpenEXR, for compositors and other programs: a folder with one file for each camera
/// (engine/store/FORMAT.md, "Captures as OpenEXR"), and captures.json, which says which camera stands where.

#include <span>

#include "engine/pipeline/pipeline.h"

namespace acentric {

inline constexpr const char* kExrIndex = "captures.json";
inline constexpr const char* kExrFormat = "acentric OpenEXR captures";

struct ExportExrOptions {
  bool allowMissing = false;  ///< write what there is; else captures that are not baked are refused
  std::string generator;
};

struct ExportExrReport {
  std::size_t files = 0, missing = 0, samples = 0;
  std::uint64_t bytes = 0;  ///< of the files
};

Status checkExrTarget(const std::filesystem::path& folder);

/// Only captures of full quality. `storeys`: all of one project, in order, as openStoreys gives them.
Result<ExportExrReport> exportExr(std::span<const OpenProject> storeys, const std::filesystem::path& folder,
                                  const ExportExrOptions& options, TaskRunner& runner,
                                  const Progress& progress = {}, const std::stop_token& stop = {});

}  // namespace acentric
