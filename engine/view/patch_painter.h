#pragma once
/// Paints patches front to back: the first that covers a part of a pixel is what the eye sees there, no depth
/// is compared, and nothing is done where all is covered.

#include "engine/view/canvas.h"
#include "engine/view/patch_plan.h"
#include "engine/view/warp.h"

namespace acentric {

/// Memory of one strip of the picture, kept from frame to frame (PatchCanvasColumn).
struct PatchCanvas {
  std::vector<std::uint32_t> open, source, mirror;
  std::vector<float> red, green, blue, clear, inverseZDepth;
  std::vector<std::uint64_t> cells, reached;
  std::vector<RowRange> rows;  ///< of a polygon, by column
};

/// Pieces of the first cover; those of the second where nothing of the first lies, before it in its cracks
/// (cracks.h), and in its place where the second has the same surface more densely (patch_kernel.h: kDenser);
/// then what mirrors show. `canvas` holds the background, and columns [x0, x1) are right
/// if it holds pixelsReadBeside more on either side. `cover` and `coverMirrors` as WarpOptions'. Counts
/// patches read and pixels painted.
WarpCounts paintPatches(const PatchPlan& plan, const PatchKernel& kernel, const CoverImage* cover,
                        std::span<const std::uint8_t> coverMirrors, int x0, int x1, PatchCanvas& memory,
                        Canvas& canvas);

}  // namespace acentric
