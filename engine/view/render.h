#pragma once
/// One frame on the CPU: cover and order (layout), warp, hole filling, local geometry (apv.md sections 2, 4,
/// 5). Renderer::scalar is the truth that the SIMD and OpenGL renderers are tested against.

#include "engine/base/task_runner.h"
#include "engine/geometry/perspective_view.h"
#include "engine/view/canvas.h"
#include "engine/view/frame.h"
#include "engine/view/patch_painter.h"
#include "engine/view/view_plan.h"
#include "engine/view/view_settings.h"
#include "engine/view/walk_scene.h"

namespace acentric {

/// How long the strips of a picture took.
struct StripTimes {
  std::vector<int> borders;     ///< from 0 to the picture's width, one more than there are strips
  std::vector<double> seconds;  ///< by strip
};

/// What frames are made in, kept from one to the next: fresh memory costs as much as what is drawn on it.
struct FrameMemory {
  std::vector<Canvas> canvases;            ///< one per strip of the picture
  std::vector<PatchCanvas> patchCanvases;  ///< the same, where patches are drawn
  StripTimes strips;  ///< of the last frame: the next one is cut so that all take as long
  FloatImage inverseZDepth;
  CoverImage cover;  ///< by local geometry
  Frame frame;       ///< a frame that is no longer needed, or an empty one
};

/// Fails when the view is out of range, or the eye stands outside every region (the message gives the nearest
/// point). `settings.renderer` must not be `gl`. The result does not depend on the number of threads.
Result<Frame> renderFrame(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings,
                          TaskRunner& runner);
Result<Frame> renderFrame(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings,
                          TaskRunner& runner, FrameMemory& memory);
/// The same after a plan that was made already, with these settings for this view.
Result<Frame> renderPlan(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings,
                         const ViewPlan& plan, TaskRunner& runner, FrameMemory& memory);

}  // namespace acentric
