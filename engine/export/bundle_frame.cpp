#include "engine/export/bundle_frame.h"

#include "engine/export/walk_pages.h"

namespace acentric {

Result<std::unique_ptr<BundlePlayer>> playerFor(const std::filesystem::path& bundle, int threads) {
  const auto read = [&]() -> Result<std::unique_ptr<BundlePlaces>> {
    std::error_code error;
    if (std::filesystem::is_directory(bundle, error)) return wholeBundle(bundleFolder(bundle));
    auto ranges = fileRanges(bundle);
    if (!ranges) return tl::unexpected(ranges.error());
    return WalkPages::open(std::move(*ranges), bundle.string());
  };
  auto places = read();
  if (!places) return tl::unexpected(places.error());
  auto player = std::make_unique<BundlePlayer>();
  player->open(std::move(*places));
  player->setThreads(threads);
  return player;
}

PerspectiveView startOf(const Bundle& bundle) {
  const BundleStorey& storey = bundle.storeys[std::size_t(bundle.storey)];
  PerspectiveView view;
  view.eye = {storey.start, storey.layout.eyeZ()};
  view.yawRadians = storey.startYaw;
  view.fovRadians = bundle.fov;
  return view;
}

Result<Frame> bundleFrame(BundlePlayer& player, const PerspectiveView& view, const ViewSettings& settings) {
  const auto needs = player.needsOf(view, settings);
  if (!needs) return tl::unexpected(needs.error());
  if (Status loaded = player.loadView(*needs, Loaded::full, settings.localGeometry); !loaded)
    return tl::unexpected(loaded.error());
  return player.render(view, settings);
}

}  // namespace acentric
