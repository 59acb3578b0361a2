#include "engine/layout/drawing_order.h"

#include <algorithm>

#include "engine/base/contract.h"
#include "engine/layout/azimuth_order.h"
#include "engine/layout/gap_order.h"
#include "engine/layout/panorama_order.h"
#include "engine/layout/point_inside.h"
#include "engine/layout/ring_order.h"

namespace acentric {

ViewSector sectorOf(const PerspectiveView& view) { return {glm::dvec2(view.eye), azimuthRange(view)}; }

Hand preferredHand(const Region& region, const glm::dvec2& eye, double viewAzimuth) {
  const glm::dvec2 toCentre = region.polygon.centroid() - eye;
  return turn(directionOf(viewAzimuth), toCentre) >= 0 ? Hand::counterClockwise : Hand::clockwise;
}

namespace {

bool isPanorama(const Cover& cover) {
  return std::ranges::all_of(cover.pieces,
                             [&](const Piece& piece) { return piece.apex == cover.pieces.front().apex; });
}

}  // namespace

const Cover& chooseCover(const Region& region, const ViewSector& sector) {
  require(!region.covers.empty(), "a region has a cover");
  const Hand hand = preferredHand(region, sector.eye, sector.azimuths.low + 0.5 * sector.azimuths.width);
  for (const Cover& cover : region.covers)
    if (cover.hand == hand) return cover;
  return region.covers.front();
}

std::vector<OrderedPiece> visiblePieces(const Layout& layout, int region, const Cover& cover,
                                        const ViewSector& sector) {
  require(region >= 0 && std::size_t(region) < layout.regions.size(), "the region exists");
  if (!std::isfinite(sector.azimuths.low) || !(sector.azimuths.width > 0)) return {};
  const Region& home = layout.regions[std::size_t(region)];
  // An eye that rounding has put just outside sees what it would see from the border.
  ViewSector fromInside = sector;
  fromInside.eye = pointInside(home.polygon, sector.eye,
                               [&](const glm::dvec2& p) { return home.polygon.containsClosed(p); });
  std::vector<OrderedPiece> ordered = isPanorama(cover) ? orderPanorama(cover, fromInside)
                                      : home.kind == RegionKind::ring
                                          ? orderRing(cover, fromInside)
                                          : orderGap(home.polygon, cover, fromInside);
  for (OrderedPiece& piece : ordered) piece.part.eye = sector.eye;
  return ordered;
}

}  // namespace acentric
