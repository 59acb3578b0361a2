#pragma once
/// Where the samples of the surfaces' own light are too far apart for what they show.

#include "engine/scene/surface_light.h"

namespace acentric {

/// Does the light of a triangle bend from sample to sample, on one of its sides, by more than three quarters
/// of itself? The edge of a shadow does, its soft side and light that falls off do not.
bool isAbrupt(const SurfaceLight& light, std::uint32_t sceneTriangle);

}  // namespace acentric
