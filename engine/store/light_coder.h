#pragma once
/// The light of surfaces as a range-coded stream (FORMAT.md, "Kind 2"): each sample is predicted from those
/// before it on its side of its triangle, red also from green and blue from both.

#include <cstddef>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/scene/surface_light.h"

namespace acentric {

/// The last bits of all channels that are 0 in every sample, four at most: they are not coded.
int unusedBits(const SurfaceLight& light);

/// Do the tables agree with each other and with the samples, and are these light? (surface_light_file.cpp)
Status checkSurfaceLight(const SurfaceLight& light);

/// Of light that checkSurfaceLight() finds sound. Alpha is not coded.
std::vector<std::byte> codeLight(const SurfaceLight& light, int unusedBits);

/// Fills in the samples, alpha 1; tables and the number of samples are known and agree.
Status decodeLight(std::span<const std::byte> stream, int unusedBits, SurfaceLight& light);

}  // namespace acentric
