#pragma once
/// A capture at a fraction of its resolution, to be shown where the whole one is not in memory.

#include "engine/image/capture.h"

namespace acentric {

/// Coarse renditions made of captures have, as previews do, a quarter of the columns and rows.
inline constexpr int kCoarseFactor = 4;

/// Of every `factor` x `factor` pixels the one in their middle with all its layers, of the whole camera's
/// view; at least one column and row. `factor` >= 1; 1 gives the capture itself.
Capture coarsened(const Capture& capture, int factor);

}  // namespace acentric
