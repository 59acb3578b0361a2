#pragma once
/// A level part of the floor on which one can walk about, as an outline: what a layout is laid on.

#include <span>
#include <vector>

#include "engine/geometry/outline.h"
#include "engine/inspect/standing.h"

namespace acentric {

struct CellMask;
struct CellLinks;

struct WalkPlane {
  double height = 0;        ///< z, metres: the middle one of its floor
  Outline outline;          ///< one outer loop and its holes, simplified to about one grid step
  double coveredShare = 0;  ///< of its floor: what lies below a ceiling, a roof or a tree
  double enclosure = 0;     ///< mean of its floor: see StandingSpot
  std::vector<int> spots;   ///< into Standing::spots
};

/// The parts of the floor within `tolerance` metres of a height, each connected by steps that stay within it,
/// largest first; at most `most`, those of fewer than `leastSpots` left out. `taken`, if not empty, marks
/// spots that belong to other planes.
std::vector<WalkPlane> planesAt(const Standing& standing, double height, double tolerance, int most,
                                int leastSpots = 1, std::span<const std::uint8_t> taken = {});

/// The largest part of a mask that holds together by links, without cells that touch at a corner only.
CellMask largestClearPart(const CellMask& mask, const CellLinks& links);
/// Around such a part: one outer loop and its holes, simplified to about one grid step.
Outline outlineAround(const CellMask& part, const ProbeGrid& grid);

}  // namespace acentric
