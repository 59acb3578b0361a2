#pragma once
/// Pictures of three planes of 8 or 10 bits each, and of colours with alpha, as AVIF files in memory, by
/// libavif: one still, intra only, 4:4:4, full range. On one thread, and the same bytes each time.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/image/image.h"

namespace acentric {

/// Rows of the planes lie one behind the other.
struct StillPicture {
  int width = 0, height = 0, bits = 0;
  std::vector<std::uint16_t> planes[3];  ///< luma, blue and red chroma
};

/// A side of a picture; libavif and browsers take no more.
inline constexpr int kMostPictureSide = 32768;
inline constexpr int kBestPictureQuality = 99;

/// `quality`: 0..kBestPictureQuality; means about the same of both scales that colour_codes.h has.
Result<std::vector<std::byte>> encodeStill(const StillPicture& picture, int quality);
/// Refused before it is decoded unless its header says that it is of this size and kind.
Result<StillPicture> decodeStill(std::span<const std::byte> file, int width, int height, int bits);

/// The same of an image of 8 bits, at most kMostPictureSide a side; alpha is exact, and left out where all is
/// opaque.
Result<std::vector<std::byte>> encodeStill(const ColourImage& image, int quality);
Result<ColourImage> decodeStillColours(std::span<const std::byte> file, int width, int height);
/// Does a file begin as AVIF files do?
bool isStill(std::span<const std::byte> file);

}  // namespace acentric
