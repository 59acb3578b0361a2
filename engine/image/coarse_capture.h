#pragma once
/// A capture at a fraction of its resolution, to be shown where the whole one is not in memory.

#include "engine/image/capture.h"

namespace acentric {

/// Coarse renditions made of captures have, as previews do, a quarter of the columns and rows.
inline constexpr int kCoarseFactor = 4;

/// Of the whole camera's view; at least one column and row. `factor` >= 1; 1 gives the capture itself. A
/// capture that knows its silhouettes has in each pixel the surfaces of `factor` x `factor` ones: their mean
/// colours, and the parts that they cover. Of others the pixel in the middle is kept, with all its layers.
Capture coarsened(const Capture& capture, int factor);

}  // namespace acentric
