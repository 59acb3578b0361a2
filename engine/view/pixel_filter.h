#pragma once
/// The last step of Reconstruction::filtered: each pixel's colour from the samples in it and in the eight
/// pixels around it, by where in their pixels they lie (kPlaceBits).
///
/// A sample weighs (1 - |dx| / s)(1 - |dy| / s), its distance from the pixel's centre in pixels, or nothing
/// beyond s, its surface's samples being s pixels apart (1 at least): between samples of a grid this is
/// bilinear interpolation. All samples count, whatever their surface: the edge between two is then as soft as
/// if each pixel had seen what it covers. Colours are averaged in light, taken as the square of the code.
/// Where nothing weighs anything, and only there, a pixel keeps its own colour.
///
/// Weights and sums are integers, and the rest is one division and one root: all variants give the same
/// codes. Free of the standard library, as warp_kernel.h is.

#include <cstdint>

namespace acentric {

/// Three neighbouring columns of canvas pixels, from one above the first to one below the last of `count`;
/// empty pixels stand for what is beyond the picture. Writes `count` colours (opaque Rgba8 words). All four
/// have room for 16 more.
using FilterPixels = void (*)(const std::uint64_t* left, const std::uint64_t* middle,
                              const std::uint64_t* right, int count, std::uint32_t* colour);

void filterPixelsScalar(const std::uint64_t* left, const std::uint64_t* middle, const std::uint64_t* right,
                        int count, std::uint32_t* colour);
void filterPixelsAvx2(const std::uint64_t* left, const std::uint64_t* middle, const std::uint64_t* right,
                      int count, std::uint32_t* colour);
void filterPixelsAvx512(const std::uint64_t* left, const std::uint64_t* middle, const std::uint64_t* right,
                        int count, std::uint32_t* colour);

}  // namespace acentric
