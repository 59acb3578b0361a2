#pragma once
/// The background as captures show it: in direction d the capture's own pixel of direction d tells, from
/// wherever one looks, for it lies infinitely far. So nothing is warped: each pixel of the picture is looked
/// up in the capture's runs of rows. It lies behind every sample and is painted before them, in the sky's
/// colour of the pixel's own direction.

#include "engine/base/task_runner.h"
#include "engine/view/canvas.h"
#include "engine/view/view_plan.h"

namespace acentric {

/// Paints plan.backgrounds on a canvas that holds nothing but other background.
void paintCapturedBackground(const WalkScene& scene, const PerspectiveView& view, const ViewPlan& plan,
                             Canvas& canvas, TaskRunner& runner);

}  // namespace acentric
