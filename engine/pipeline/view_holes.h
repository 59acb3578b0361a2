#pragma once
/// Which pixels of a view would be open, told without captures: pixel by pixel, what the eye sees, and
/// whether the captures that the view draws hold it (surface_coverage.h says when).
///
/// A rendered frame counts a pixel as a hole if no real sample fell on it though the truth has a surface
/// there. That is less than what is missed: behind a surface that no capture holds, another may be held and
/// paint the pixel (wrongly). Both are told apart here. Patches of surfaces reach as far as their surface is
/// captured; between splats more may be open.

#include "engine/base/task_runner.h"
#include "engine/geometry/perspective_view.h"
#include "engine/image/image.h"
#include "engine/inspect/capture_reach.h"
#include "engine/view/view_settings.h"

namespace acentric {

struct ViewHoles {
  /// Shares of all pixels.
  double missed = 0;               ///< what the eye sees there is in no capture that the view draws
  double open = 0;                 ///< nor is anything behind it
  Image<std::uint8_t> openPixels;  ///< 1, else 0
  FloatImage rayDistance;          ///< metres to the first opaque surface; infinity = none
};

/// `settings`: what the view draws, and how large. Its eye stands in one of the layout's regions.
Result<ViewHoles> predictHoles(const CaptureReach& reach, const PerspectiveView& view,
                               const ViewSettings& settings, TaskRunner& runner);

}  // namespace acentric
