#pragma once
/// PNG in memory.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/image/image.h"

namespace acentric {

/// As 8-bit RGBA, straight alpha. A picture that its header says is not `width` by `height` is refused before
/// anything of its size is allocated: a few kilobytes of PNG may unpack to gigabytes.
Result<ColourImage> decodePng(std::span<const std::byte> bytes, int width, int height,
                              const std::string& name);
/// 8 bits, without alpha where all of it is opaque.
Result<std::vector<std::byte>> encodePng(const ColourImage& image);
/// One channel of 16 bits; `values` row by row.
Result<std::vector<std::byte>> encodePng(int width, int height, std::span<const std::uint16_t> values);

}  // namespace acentric
