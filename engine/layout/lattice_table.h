#pragma once
/// The lattice of each configuration as plain data (apv.md section 3): how unit cells repeat, which corners
/// and regions a cell has, and which cameras stand at each corner. Lengths in units of the regular polygon's
/// edge, angles in steps of 15 degrees, both relative to the unrotated lattice. Everything else is derived.

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "engine/layout/layout.h"

namespace acentric {

/// A lattice corner as seen from a unit cell: corner number `corner` of the cell (di, dj) further.
struct CornerRef {
  int di = 0, dj = 0, corner = 0;
};

struct RegionTemplate {
  RegionKind kind = RegionKind::ring;
  std::vector<CornerRef> corners;  ///< counter-clockwise
};

struct LatticeTable {
  glm::dvec2 stepI{0}, stepJ{0};          ///< from a cell to the next
  std::vector<glm::dvec2> cornerOffsets;  ///< from the cell's ring centre, by corner number
  std::vector<RegionTemplate> regions;    ///< by slot; slot 0 is a ring around the cell's origin
  /// Can regions be split? Then the one corner of a cell at (i, j) / 2^level is the corner of all levels.
  bool splits() const { return cornerOffsets.size() == 1; }
  int apvSteps = 0;     ///< the configuration's field of view v
  int cameraSteps = 0;  ///< of a stored camera; divides apvSteps, at most 4 (60 degrees)
  double cellArea = 0;  ///< of a unit cell, in squared edge lengths
};

/// Nothing for a value that is none of a to g.
const LatticeTable* latticeTable(Configuration configuration);

}  // namespace acentric
