#pragma once
/// The covers of a region of a lattice, by integers only: which camera at which corner, and between which
/// lines. One description serves every cell of the lattice; lattice.h turns it into positions.

#include <vector>

#include "engine/layout/lattice_table.h"

namespace acentric {

/// A border line through two of the region's corners (by number), or, for the border between two sub-cameras
/// of one corner, from the corner `from` along a direction.
struct BorderTemplate {
  int from = 0;
  int to = -1;        ///< -1: along `direction`
  int direction = 0;  ///< steps of 15 degrees, 0..23
};

struct PieceTemplate {
  int apex = 0;       ///< number of the region's corner
  int direction = 0;  ///< of the low border
  BorderTemplate low, high;
};

struct CoverTemplate {
  Hand hand = Hand::counterClockwise;
  std::vector<PieceTemplate> pieces;
  int wedges = 0;
};

/// Ring: both hands. Gap triangle: wedges, then strips.
std::vector<CoverTemplate> coverTemplates(const LatticeTable& table, int slot);

}  // namespace acentric
