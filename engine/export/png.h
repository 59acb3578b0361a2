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

/// As 8-bit RGBA, straight alpha.
Result<ColourImage> decodePng(std::span<const std::byte> bytes, const std::string& name);
/// 8 bits, without alpha where all of it is opaque.
Result<std::vector<std::byte>> encodePng(const ColourImage& image);
/// One channel of 16 bits; `values` row by row.
Result<std::vector<std::byte>> encodePng(int width, int height, std::span<const std::uint16_t> values);

}  // namespace acentric
