#pragma once
/// Pictures in memory, and reading and writing them (OpenImageIO).

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/base/result.h"

namespace acentric {

/// width*height pixels, row 0 on top, no padding.
template <class Pixel>
struct Image {
  int width = 0;
  int height = 0;
  std::vector<Pixel> pixels;

  Image() = default;
  Image(int w, int h, Pixel fill = {}) : width(w), height(h), pixels(std::size_t(w) * std::size_t(h), fill) {}
  Pixel& at(int x, int y) { return pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
  const Pixel& at(int x, int y) const { return pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
  bool empty() const { return pixels.empty(); }
};

using Rgba8 = glm::u8vec4;  ///< sRGB-encoded colour, straight alpha
using ColourImage = Image<Rgba8>;
using FloatImage = Image<float>;
using LinearImage = Image<glm::vec3>;  ///< linear radiance, Rec.709 primaries

/// PNG, JPEG, ... as 8-bit RGBA. Refuses pictures above `maxPixels`.
Result<ColourImage> readColourImage(const std::filesystem::path& path, std::size_t maxPixels = std::size_t(1)
                                                                                               << 28);
/// The same from the bytes of a file already in memory; `name` is for messages.
Result<ColourImage> decodeColourImage(std::span<const std::byte> bytes, const std::string& name,
                                      std::size_t maxPixels = std::size_t(1) << 28);
/// By extension (.png, .jpg, ...), atomically.
Status writeColourImage(const ColourImage& image, const std::filesystem::path& path);
/// One float channel as OpenEXR, atomically.
Status writeFloatImage(const FloatImage& image, const std::filesystem::path& path, const char* channel);
/// An equirectangular picture of the same size as its distances, as OpenEXR that says so (envmap latlong),
/// atomically: R, G, B as half floats, Z as float.
Status writePanorama(const LinearImage& radiance, const FloatImage& distance,
                     const std::filesystem::path& path);

}  // namespace acentric
