#pragma once
/// Lays a lattice over a walkable outline so that few cameras serve much of its floor and stand well: shifted
/// within one of its cells, turned along the outline's walls, without cells that have hardly any floor.

#include <stop_token>

#include "engine/inspect/lattice_shift.h"

namespace acentric {

/// Regions with less floor than this share of their area are left out: hardly anyone can stand there.
inline constexpr double kLeastFloor = 0.2;

struct LatticeFitOptions {
  ShiftOptions shift;      ///< which origins are tried, at each turn
  double mostLost = 0.03;  ///< share of the floor that cells left out may have together
};

struct LatticeFit {
  LayoutSpec spec;
  double served = 0;  ///< share of the outline's floor that regions have
};

/// The spec with the origin, rotation and cells left out at which sum(1 + lack) / served^3 over its cameras
/// is least; a camera's lack as in crowding(). Turned are the outline's walls' way and across it, if that is
/// a twentieth better than the spec's own rotation. Of cells with little floor (kLeastFloor) the barest are
/// left out first, as long as the floor stays in one piece. What is fitted stays. The spec itself where
/// nothing is placed. Forgets cells that the spec names. Stopped: the best so far.
LatticeFit fitLattice(const LayoutSpec& spec, const LatticeFitOptions& options, const SurfaceProbe& probe,
                      std::stop_token stop = {});

}  // namespace acentric
