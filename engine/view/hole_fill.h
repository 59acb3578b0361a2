#pragma once
/// Screen-space fill of pixels for which no sample exists. What it makes up is marked kSourceInvented and
/// never counted as covered.

#include "engine/view/frame.h"

namespace acentric {

/// Grows the background into the holes, ring by ring, from the farther side of each: a hole opens behind the
/// edge of something near, so what belongs there is the farther surface. Local geometry spreads only where no
/// background borders on the hole. `inverseZDepth` (1/m) belongs to `frame`; filled pixels get theirs. Holes
/// farther than `maxRings` pixels from anything known stay open. Work is proportional to the holes.
void fillHoles(Frame& frame, FloatImage& inverseZDepth, int maxRings);

}  // namespace acentric
