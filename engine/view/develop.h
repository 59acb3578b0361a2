#pragma once
/// Turns a painted canvas into a frame: rows of colours and sources, and depth for the passes that follow.

#include "engine/view/canvas.h"
#include "engine/view/frame.h"

namespace acentric {

/// Writes columns [x0, x1) of the picture, which the canvas holds. `sources`: by slot. `frame` and
/// `inverseZDepth` (1/m, 0 in holes) are as large as the picture.
void develop(const Canvas& canvas, int x0, int x1, const std::vector<PixelSource>& sources, Frame& frame,
             FloatImage& inverseZDepth);

}  // namespace acentric
