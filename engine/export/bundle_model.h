#pragma once
/// Parts of a bundle as models (draw_model.h), for renderers that are not ours.

#include "engine/export/bundle_player.h"
#include "engine/export/draw_model.h"

namespace acentric {

/// Of a capture all that any region draws, in meshes by roles, around its camera. Refused where it has no
/// planes.
Result<DrawModel> captureModel(const BundlePlayer& player, std::size_t storey, std::size_t camera,
                               Loaded detail, int texturePixels, const std::stop_token& stop = {});
/// What is near a region, and the sky, around the region's middle at the height of the eye.
Result<DrawModel> regionModel(const BundlePlayer& player, std::size_t storey, std::size_t region,
                              int texturePixels, BundlePlayer::Images known = {});

}  // namespace acentric
