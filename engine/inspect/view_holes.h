#pragma once
/// Which pixels of a view would be open, told without captures: pixel by pixel, what the eye sees, and
/// whether the captures that the view draws hold it (surface_coverage.h says when).
///
/// A rendered frame counts a pixel as a hole if no real sample fell on it though the truth has a surface
/// there. That is less than what is missed: behind a surface that no capture holds, another may be held and
/// paint the pixel (wrongly). And it is more: where a surface lies slanted to the camera and the eye sees it
/// straight, the splats part. Both are told apart here.

#include "engine/base/task_runner.h"
#include "engine/geometry/perspective_view.h"
#include "engine/image/image.h"
#include "engine/inspect/capture_reach.h"

namespace acentric {

struct ViewHoleOptions {
  bool everyCover = true;     ///< the other hand is painted too, behind
  bool localGeometry = true;  ///< the near band is drawn from the scene's triangles
  double splatFactor = 1.25;  ///< splats are so much larger than a sample seen face on; 0: points
  double maxSplatPixels = 16;
};

struct ViewHoles {
  /// Shares of all pixels.
  double missed = 0;       ///< what the eye sees there is in no capture that the view draws
  double open = 0;         ///< nor is anything behind it
  double expected = 0;     ///< mean probability that no splat falls there
  FloatImage openness;     ///< that probability, by pixel
  FloatImage rayDistance;  ///< metres to the first opaque surface; infinity = none
};

/// The view's eye stands in one of the layout's regions.
Result<ViewHoles> predictHoles(const CaptureReach& reach, const PerspectiveView& view,
                               const ViewHoleOptions& options, TaskRunner& runner);

}  // namespace acentric
