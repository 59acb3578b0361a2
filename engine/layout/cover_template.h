#pragma once
/// The covers of a region of a lattice, by integers only: which camera at which corner, and between which
/// lines. One description serves every cell of the lattice; lattice.h turns it into positions.

#include <optional>
#include <vector>

#include "engine/layout/lattice_table.h"

namespace acentric {

/// A line through two of the region's corners (by number), through the middles of two of its edges (edge k
/// begins at corner k), or, for the border between two sub-cameras of one corner, from the corner `from`
/// along a direction.
struct BorderTemplate {
  enum class Through { corners, middles, direction };
  int from = 0;
  int to = 0;  ///< along a direction: steps of 15 degrees, 0..23
  Through through = Through::corners;
};

struct ClipTemplate {
  BorderTemplate line;
  bool left = true;  ///< HalfPlane::left
  std::optional<BorderTemplate>
      claim;  ///< the neighbour's: its left side, if `left` is false; else its right
};

struct PieceTemplate {
  int apex = 0;       ///< number of the region's corner
  int direction = 0;  ///< of the low border
  BorderTemplate low, high;
  std::optional<ClipTemplate> clip = std::nullopt;
};

struct CoverTemplate {
  Hand hand = Hand::counterClockwise;
  std::vector<PieceTemplate> pieces;
  int wedges = 0;
};

/// Rings: both hands. Gaps: wedges in order of corners (sub-cameras counter-clockwise), then strips in order
/// of edges; squares and hexagons with both choices of the strips' cameras.
std::vector<CoverTemplate> coverTemplates(const LatticeTable& table, int slot);

}  // namespace acentric
