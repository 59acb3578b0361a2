#pragma once
/// What image.h reads and writes by OpenImageIO, in a module that is loaded when the first file needs it:
/// Debian's OpenImageIO brings 250 libraries, which take a quarter of a second to load, and most commands
/// read no image.

#include "engine/image/image.h"

namespace acentric {

/// The module's only symbol, and what it holds. Each does what the function of image.h of its name does.
inline constexpr char kImageFilesSymbol[] = "acentric_image_files";
struct ImageFiles {
  Result<ColourImage> (*decodeColourImage)(std::span<const std::byte> bytes, const std::string& name,
                                           std::size_t maxPixels);
  Status (*writeColourImage)(const ColourImage& image, const std::filesystem::path& path);
  Status (*writeFloatImage)(const FloatImage& image, const std::filesystem::path& path, const char* channel);
  Status (*writePanorama)(const LinearImage& radiance, const FloatImage& distance,
                          const std::filesystem::path& path);
};

}  // namespace acentric
