#pragma once
/// Pictures of a scene with distances, ray-traced from places to stand, for programs that make scenes of
/// pictures (engine/export/posed_images.h): six faces of a cube from the middle of each region, or a
/// panorama.

#include "engine/export/posed_images.h"
#include "engine/pipeline/pipeline.h"

namespace acentric {

enum class ImageSetFormat : std::uint8_t { colmap, nerfstudio, seurat, panoramas };

struct ExportImagesOptions {
  ImageSetFormat format = ImageSetFormat::nerfstudio;
  int facePixels = 512;  ///< side of a face, 16..8192; a panorama is four as wide and two as high
  std::optional<int> onlyRegion;
  std::size_t mostPoints = 200'000;  ///< of the cloud of points (COLMAP, nerfstudio)
  Status check() const;
};

struct ExportImagesReport {
  std::size_t images = 0, points = 0;
};

/// `folder` is new or empty.
Result<ExportImagesReport> exportImages(const OpenProject& open, const std::filesystem::path& folder,
                                        const ExportImagesOptions& options, TaskRunner& runner,
                                        const Progress& progress = {}, const std::stop_token& stop = {});

}  // namespace acentric
