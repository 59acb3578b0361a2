#pragma once
/// The paper's own procedures, as written: view culling in a ring (section 3.1) and in a gap triangle (Fig.
/// 10). The walk uses visiblePieces, which serves every view; these are its witnesses where the paper's
/// premises hold.
///
/// Fig. 10 has a premise that the paper leaves unsaid: the view must reach the chosen interior camera's
/// strip. A narrow view turned away from it (wholly beyond the COP of the exterior camera beside it) needs
/// that exterior camera and the next interior one instead.

#include <vector>

#include "engine/layout/drawing_order.h"

namespace acentric {

/// Cameras back to front. The eye lies inside the ring, the view is narrower than 180 degrees.
std::vector<int> cullRingAsInPaper(const Cover& ring, const ViewSector& view);

/// Cameras back to front. The eye lies inside the triangle, the view is narrower than 60 degrees.
std::vector<int> cullTriangleAsInPaper(const Cover& gap, const ViewSector& view);

}  // namespace acentric
