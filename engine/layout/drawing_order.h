#pragma once
/// Which pieces of a region's cover a view shows, back to front (paper 3.1, 4; apv.md sections 1 and 3).

#include <optional>
#include <vector>

#include "engine/geometry/perspective_view.h"
#include "engine/layout/layout.h"

namespace acentric {

/// The horizontal extent of a view, in plan. width up to 2 pi.
struct ViewSector {
  glm::dvec2 eye{0};
  AzimuthRange azimuths;
};
ViewSector sectorOf(const PerspectiveView& view);

struct OrderedPiece {
  int camera = 0;   ///< into Layout::cameras
  ViewSector part;  ///< the part of the view in which this place in the order holds (all of it, unless the
                    ///< view was split)
  std::optional<Clip> clip = std::nullopt;  ///< the piece's: samples outside it are not drawn
};

/// Hand to use in a ring, or for the strips of a gap square or hexagon: counter-clockwise when the polygon's
/// centre lies left of the viewing ray (paper Fig. 8).
Hand preferredHand(const Region& region, const glm::dvec2& eye, double viewAzimuth);

/// Visible pieces of one of the region's covers, or of a panorama (Layout::panoramasFor), back to front. For
/// an eye inside the region and any width; views wider than one linear order serves are split, and each
/// part's pieces follow in order (parts do not overlap on the picture).
std::vector<OrderedPiece> visiblePieces(const Layout& layout, int region, const Cover& cover,
                                        const ViewSector& sector);

/// The cover that the paper chooses for this view (hand rule).
const Cover& chooseCover(const Region& region, const ViewSector& sector);

}  // namespace acentric
