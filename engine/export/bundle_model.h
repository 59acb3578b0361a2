#pragma once
/// Parts of a bundle as models (draw_model.h), for renderers that are not ours.

#include <stop_token>

#include "engine/export/bundle_place.h"
#include "engine/export/draw_model.h"

namespace acentric {

/// Of a capture all that any region draws, in meshes by roles, around its camera. Refused where it has no
/// planes. Numbers are those within the place.
Result<DrawModel> captureModel(const BundlePlace& place, std::size_t camera, Loaded detail, int texturePixels,
                               const std::stop_token& stop = {});
/// What is near a region, and the sky, around the region's middle at the height of the eye.
Result<DrawModel> regionModel(const BundlePlacePtr& place, std::size_t region, int texturePixels,
                              Images known = {});

}  // namespace acentric
