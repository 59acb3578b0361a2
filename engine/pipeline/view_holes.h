#pragma once
/// Which pixels of a view would be open, told without captures: pixel by pixel, what the eye sees, and
/// whether the captures that the view draws hold it (surface_coverage.h says when).
///
/// A rendered frame counts a pixel as a hole if no real sample fell on it though the truth has a surface
/// there. That is less than what is missed: behind a surface that no capture holds, another may be held and
/// paint the pixel (wrongly). And it is more: what is thinner than the samples lie apart falls between them,
/// and where a surface lies slanted to the camera and the eye sees it straight, the splats part. All are told
/// apart here; the last by looking along those rays of the cameras whose samples may lie on the pixel.

#include "engine/base/task_runner.h"
#include "engine/geometry/perspective_view.h"
#include "engine/image/image.h"
#include "engine/inspect/capture_reach.h"
#include "engine/view/view_settings.h"

namespace acentric {

struct ViewHoles {
  /// Shares of all pixels.
  double missed = 0;         ///< what the eye sees there is in no capture that the view draws
  double open = 0;           ///< nor is anything behind it
  double expected = 0;       ///< no splat of a sample falls there
  Image<std::uint8_t> bare;  ///< pixels on which none falls: 1, else 0
  FloatImage rayDistance;    ///< metres to the first opaque surface; infinity = none
};

/// `settings`: what the view draws, and how large. Its eye stands in one of the layout's regions.
Result<ViewHoles> predictHoles(const CaptureReach& reach, const PerspectiveView& view,
                               const ViewSettings& settings, TaskRunner& runner);

}  // namespace acentric
