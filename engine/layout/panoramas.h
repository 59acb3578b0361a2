#pragma once
/// Traditional panoramas in the middle of regions: what a region's own cameras, which stand at its corners,
/// leave open is often seen from its middle (paper section 5: APV and TPV together leave the fewest holes).

#include <cstddef>

#include "engine/layout/layout_spec.h"

namespace acentric {

/// A region is helped by so many free panoramas at most (Layout::panoramasFor): those within reach whose
/// centres are nearest to its own, the nearest last and so in front.
inline constexpr std::size_t kMostPanoramas = 4;

/// Which regions get one: the rings, each from its own centre, or every region.
enum class PanoramaPlaces { rings, regions };

/// Adds a free panorama of six cameras at the centre of each such placed region that has none there. How many
/// were added. Fails when they are more than kMaxFreeApvs with those that are there.
Result<int> addPanoramas(LayoutSpec& spec, PanoramaPlaces places);
/// Takes all free panoramas away. How many there were.
int removePanoramas(LayoutSpec& spec);

}  // namespace acentric
