#include "engine/view/view_cameras.h"

#include <algorithm>

#include "engine/layout/drawing_order.h"

namespace acentric {

ViewCameras camerasOf(const Layout& layout, const PerspectiveView& view, const ViewSettings& settings) {
  const auto index = layout.regionAt(glm::dvec2(view.eye));
  if (!index) return {};
  ViewCameras needed{*index, {}};
  const Region& region = layout.regions[std::size_t(*index)];
  const ViewSector sector = sectorOf(view);
  const auto add = [&](const Cover& cover) {
    for (const OrderedPiece& piece : visiblePieces(layout, *index, cover, sector))
      needed.cameras.push_back(piece.camera);
  };
  if (settings.secondaryCover) {
    for (const Cover& panorama : layout.panoramasFor(*index)) add(panorama);
    for (const Cover& cover : region.covers) add(cover);
  } else {
    add(chooseCover(region, sector));
  }
  std::ranges::sort(needed.cameras);
  const auto repeats = std::ranges::unique(needed.cameras);
  needed.cameras.erase(repeats.begin(), repeats.end());
  return needed;
}

}  // namespace acentric
