#pragma once
/// Back-to-front order of a gap's pieces: corner wedges first, edge strips over them (apv.md section 3).

#include "engine/layout/drawing_order.h"

namespace acentric {

/// The eye lies in the closed gap. Every ray crosses one strip and then possibly wedges, or wedges alone; the
/// lines between wedges (and between the sub-cameras of one) all run out from the gap's middle, so a ray
/// crosses them away from the eye's side: one order serves every width.
std::vector<OrderedPiece> orderGap(const ConvexPolygon& gap, const Cover& cover, const ViewSector& sector);

}  // namespace acentric
