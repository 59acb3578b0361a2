#pragma once
/// A capture at a fraction of its resolution, to be shown where the whole one is not in memory.

#include "engine/image/capture.h"

namespace acentric {

/// What stands in for a capture in memory has a quarter of its columns and rows.
inline constexpr int kCoarseFactor = 4;

/// Of the whole camera's view; at least one column and row. `factor` >= 1; 1 gives the capture itself. A
/// capture that knows its silhouettes has in each pixel the surfaces of `factor` x `factor` ones: their mean
/// colours, and the parts that they cover. Of others the pixel in the middle is kept, with all its layers.
Capture coarsened(const Capture& capture, int factor);

}  // namespace acentric
