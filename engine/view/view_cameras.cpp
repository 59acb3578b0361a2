#include "engine/view/view_cameras.h"

#include <algorithm>

#include "engine/layout/drawing_order.h"

namespace acentric {

std::vector<int> paintingOrder(const Layout& layout, const PerspectiveView& view,
                               const ViewSettings& settings) {
  const auto index = layout.regionAt(glm::dvec2(view.eye));
  std::vector<int> cameras;
  if (!index) return cameras;
  const Region& region = layout.regions[std::size_t(*index)];
  const ViewSector sector = sectorOf(view);
  const auto add = [&](const Cover& cover) {
    for (const OrderedPiece& piece : visiblePieces(layout, *index, cover, sector))
      if (std::ranges::find(cameras, piece.camera) == cameras.end()) cameras.push_back(piece.camera);
  };
  const Cover& chosen = chooseCover(region, sector);
  if (settings.secondaryCover) {
    for (const Cover& panorama : layout.panoramasFor(*index)) add(panorama);
    for (const Cover& cover : region.covers)
      if (&cover != &chosen) add(cover);
  }
  add(chosen);
  return cameras;
}

ViewCameras camerasOf(const Layout& layout, const PerspectiveView& view, const ViewSettings& settings) {
  const auto index = layout.regionAt(glm::dvec2(view.eye));
  if (!index) return {};
  ViewCameras needed{*index, paintingOrder(layout, view, settings)};
  std::ranges::sort(needed.cameras);
  return needed;
}

}  // namespace acentric
