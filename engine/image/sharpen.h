#pragma once
/// Colours of a capture's samples as texels that are interpolated.

#include <span>
#include <vector>

#include "engine/image/capture.h"
#include "engine/image/image.h"
#include "engine/image/patches.h"

namespace acentric {

/// Of the difference from each neighbour, what is added. At 1/8 means and interpolation together would keep
/// slow changes as they are; but what is raised has the noise of coded colours in it (docs/patches.md).
inline constexpr float kSharpening = 0.06f;

/// A sample's colour is the mean over its pixel; bilinear interpolation between means averages once more.
/// What each differs by from its four neighbours on the same surface is raised, so that what is interpolated
/// comes nearer to what the means were taken of. Of samples that have planes (one surface: within `tolerance`
/// 1/m of each other's); `colours` are theirs, sRGB with straight alpha.
std::vector<Rgba8> sharpenedColours(const ColumnCamera& camera, const CaptureSamples& samples,
                                    const PixelSamples& pixels, double tolerance,
                                    std::span<const Rgba8> colours);

}  // namespace acentric
