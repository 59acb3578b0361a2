#include "engine/export/bundle_model.h"

#include <fmt/format.h>

#include "engine/export/near_model.h"
#include "engine/export/patch_model.h"
#include "engine/export/sky_model.h"

namespace acentric {

Result<DrawModel> captureModel(const BundlePlace& place, std::size_t camera, Loaded detail, int texturePixels,
                               const std::stop_token& stop) {
  const auto capture = readCapture(place, camera, detail);
  if (!capture) return tl::unexpected(capture.error());
  if (!(*capture)->hasPatches())
    return fail(ErrorKind::unsupported, "has no planes of surfaces, which models are made of",
                fmt::format("storey {}, camera {}", place.storey, place.cameras[camera]));
  DrawModel model;
  model.origin = (*capture)->camera.centreOfProjection;
  const ShownCapture shown{capture->get(), 0xff};
  addPatches({&shown, 1}, RoleMeshes::apart, texturePixels, model, stop);
  if (stop.stop_requested()) return fail(ErrorKind::cancelled, "making a model was stopped");
  return model;
}

Result<DrawModel> regionModel(const BundlePlacePtr& place, std::size_t region, int texturePixels,
                              Images known) {
  auto read = readRegion(*place, region, std::move(known));
  if (!read) return tl::unexpected(read.error());
  const WalkScene walk = walkSceneOf(place, sceneOf(*place->bundle, std::move(read->images)));
  DrawModel model;
  model.origin = {walk.layout->regions[region].polygon.centroid(), walk.layout->eyeZ()};
  addNear(walk, region, read->local, texturePixels, model);
  addSky(walk, model.origin, model);
  return model;
}

}  // namespace acentric
