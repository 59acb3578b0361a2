#pragma once
/// Back-to-front order of a ring's cameras (apv.md section 1) for views of any width up to a full turn.

#include "engine/layout/drawing_order.h"

namespace acentric {

/// The eye lies in the closed polygon of the ring. `cover` is one hand's ring, sub-cameras included.
std::vector<OrderedPiece> orderRing(const Cover& cover, const ViewSector& sector);

}  // namespace acentric
