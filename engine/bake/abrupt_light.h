#pragma once
/// Where the samples of the surfaces' own light are too far apart for what they show.

#include "engine/scene/surface_light.h"

namespace acentric {

/// The mean of all samples' largest channels: what is bright in this scene.
float usualLight(const SurfaceLight& light);

/// Does the light of a triangle bend from sample to sample, on one of its sides, by more than three quarters
/// of itself and of the usual? The edge of a shadow does; its soft side, light that falls off and what is
/// dark do not.
bool isAbrupt(const SurfaceLight& light, std::uint32_t sceneTriangle, float usual);

}  // namespace acentric
