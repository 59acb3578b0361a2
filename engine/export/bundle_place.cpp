#include "engine/export/bundle_place.h"

#include <fmt/format.h>

#include <algorithm>

namespace acentric {

std::optional<std::size_t> BundlePlace::cameraIn(std::uint64_t number) const {
  const auto found = std::ranges::find(cameras, number);
  if (found == cameras.end()) return std::nullopt;
  return std::size_t(found - cameras.begin());
}

std::optional<std::size_t> BundlePlace::regionIn(std::uint64_t number) const {
  const auto found = std::ranges::lower_bound(regions, number);
  if (found == regions.end() || *found != number) return std::nullopt;
  return std::size_t(found - regions.begin());
}

Loaded renditionOf(const BundleCamera& camera, Loaded detail) {
  if (!camera.full && !camera.coarse) return Loaded::absent;
  if (detail == Loaded::full) return camera.full ? Loaded::full : Loaded::coarse;
  return camera.coarse ? Loaded::coarse : Loaded::full;
}

Result<CapturePtr> readCapture(const BundlePlace& place, std::size_t camera, Loaded detail) {
  const BundleCamera& renditions = place.here().cameras[camera];
  const auto& file = detail == Loaded::full ? renditions.full : renditions.coarse;
  if (!file)
    return fail(ErrorKind::notFound, "was not baked",
                fmt::format("storey {}, camera {}", place.storey, place.cameras[camera]));
  const auto read = readBundleCapture(*place.files, place.here(), camera, *file);
  if (!read) return tl::unexpected(read.error());
  return std::make_shared<const DisplayCapture>(prepareForDisplay(*read, place.bundle->exposure));
}

Result<ReadRegion> readRegion(const BundlePlace& place, std::size_t region, Images known) {
  const Bundle& bundle = *place.bundle;
  auto local = readBundleLocal(*place.files, bundle, place.here(), region);
  if (!local) return tl::unexpected(local.error());
  ReadRegion read{place.here().layout.regions[region].polygon.centroid(), std::move(*local),
                  Images(bundle.textures.size())};
  const auto imageOf = [&](std::size_t texture) -> Result<std::shared_ptr<const ColourImage>> {
    const BundleTexture& described = bundle.textures[texture];
    for (std::size_t t = 0; t < known.size(); ++t)  // several textures may share a picture
      if (known[t] && bundle.textures[t].file == described.file) return known[t];
    auto image = readBundleTexture(*place.files, described);
    if (!image) return tl::unexpected(image.error());
    return std::make_shared<const ColourImage>(std::move(*image));
  };
  known.resize(bundle.textures.size());
  for (const Mesh& mesh : read.local.surfaces->meshes) {
    const Material& material = bundle.materials[std::size_t(mesh.material)];
    for (const TextureUse* use : {&material.baseColourTexture, &material.emissiveTexture}) {
      if (!use->used()) continue;
      const auto texture = std::size_t(use->texture);
      auto image = imageOf(texture);
      if (!image) return tl::unexpected(image.error());
      known[texture] = read.images[texture] = std::move(*image);
    }
  }
  return read;
}

WalkScene walkSceneOf(const BundlePlacePtr& place, ScenePtr scene) {
  return walkSceneOf(*place->bundle, {place, &place->here().layout}, std::move(scene));
}

}  // namespace acentric
