#pragma once
/// Turns a painted canvas into a frame: rows of colours and sources, and depth for the passes that follow.

#include "engine/base/task_runner.h"
#include "engine/view/canvas.h"
#include "engine/view/frame.h"
#include "engine/view/pixel_filter.h"

namespace acentric {

/// `sources`: by slot. A canvas that keeps places is filtered with `filter`; pixels without a sample stay as
/// they are. `frame` and `inverseZDepth` (1/m) have the canvas' size.
void develop(const Canvas& canvas, const std::vector<PixelSource>& sources, FilterPixels filter, Frame& frame,
             FloatImage& inverseZDepth, TaskRunner& runner);

}  // namespace acentric
