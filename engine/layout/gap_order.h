#pragma once
/// Back-to-front order of a gap's pieces: corner wedges first, edge strips over them (apv.md section 3).

#include "engine/layout/drawing_order.h"

namespace acentric {

/// The eye lies in the closed gap. Every ray crosses one strip and then possibly one wedge, or a wedge alone,
/// so one order serves every width.
std::vector<OrderedPiece> orderGap(const Cover& cover, const ViewSector& sector);

}  // namespace acentric
