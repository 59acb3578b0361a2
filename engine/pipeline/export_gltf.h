#pragma once
/// A project as glTF 2.0 (engine/export/gltf_region.h): a folder with a GLB for each region, and walk.json,
/// which says where each region lies and which file shows it. Or as 3D Tiles (engine/export/tileset.h): the
/// same with tileset.json in its place.

#include "engine/export/gltf_region.h"
#include "engine/export/tileset.h"
#include "engine/pipeline/pipeline.h"

namespace acentric {

inline constexpr const char* kGltfIndex = "walk.json";
inline constexpr const char* kGltfFormat = "acentric glTF walk";

struct ExportGltfOptions {
  bool tiles = false;  ///< tileset.json; else walk.json
  GltfOptions region;
  bool allowMissing = false;      ///< write what there is; else captures that are not baked are refused
  std::optional<int> onlyRegion;  ///< of the storey where the walk begins
  std::size_t memoryBytes = std::size_t(2) << 30;  ///< for captures
};

struct ExportGltfReport {
  std::vector<GltfRegionReport> regions;
  GltfRegionReport sum() const;
};

Status checkGltfTarget(const std::filesystem::path& folder, bool tiles);

/// `storeys`: all of one project, in order, as openStoreys gives them.
Result<ExportGltfReport> exportGltf(std::span<const OpenProject> storeys, const std::filesystem::path& folder,
                                    const ExportGltfOptions& options, TaskRunner& runner,
                                    const Progress& progress = {}, const std::stop_token& stop = {});

}  // namespace acentric
