#pragma once
/// Screen-space fill of pixels for which no sample exists. What it makes up is marked kSourceInvented and
/// never counted as covered.

#include "engine/base/task_runner.h"
#include "engine/view/frame.h"

namespace acentric {

/// Continues the farther side of each hole: it opens behind the edge of something near, so what belongs there
/// is the farther surface. Along lines through the hole where those are short, and ring by ring from what is
/// known in wide ones. Local geometry spreads only where no background borders on the hole. `inverseZDepth`
/// (1/m) belongs to `frame`; filled pixels get theirs. Holes farther than `maxRings` pixels from anything
/// known stay open. Work is proportional to the holes.
void fillHoles(Frame& frame, FloatImage& inverseZDepth, int maxRings, TaskRunner& runner);

}  // namespace acentric
