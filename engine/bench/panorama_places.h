#pragma once
/// Where panoramas stand that a project's rings are compared with.

#include "engine/bench/representation.h"
#include "engine/inspect/standing_area.h"
#include "engine/layout/panorama_set.h"

namespace acentric {

/// A picture is painted from so many panoramas, the nearest ones, unless boxes are drawn.
inline constexpr std::size_t kPanoramasDrawn = 4;
/// Of a head box: its centre and its corners.
inline constexpr std::size_t kPanoramasOfBox = 5;

/// Panoramas that the sectors of a layout's cameras add up to, at least one.
std::size_t panoramasIn(const Layout& layout);

// Fail where there is nowhere to stand.
/// One in each room (inspect/rooms.h).
Result<PanoramaSet> roomPanoramas(const Workplace& at);
/// About `count` on a square grid.
Result<PanoramaSet> gridPanoramas(const Workplace& at, std::size_t count);
/// As many as the grid of `count` has, each where it sees most that is unseen yet (inspect/greedy_places.h);
/// the grid's places are among those that are chosen from.
Result<PanoramaSet> greedyPanoramas(const Workplace& at, std::size_t count);
/// About `count` head boxes side by side: groups of kPanoramasOfBox. A corner off the walkable area is drawn
/// towards the centre. One box is drawn, the one that is nearest.
Result<PanoramaSet> boxPanoramas(const Workplace& at, std::size_t count);

}  // namespace acentric
