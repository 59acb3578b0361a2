#pragma once
/// The background as captures show it: in direction d the capture's own pixel of direction d tells, from
/// wherever one looks, for it lies infinitely far. So nothing is warped: each pixel of the picture is looked
/// up in the capture's runs of rows. It lies behind every sample and is painted before them, in the sky's
/// colour of the pixel's own direction.

#include "engine/view/canvas.h"
#include "engine/view/sky_table.h"
#include "engine/view/view_plan.h"

namespace acentric {

class CapturedBackground {
 public:
  /// Of plan.backgrounds; scene and plan outlive it.
  CapturedBackground(const WalkScene& scene, const ViewPlan& plan);

  /// On a canvas that holds nothing but other background.
  void paint(const PerspectiveView& view, Canvas& canvas) const;

 private:
  const DisplayCapture& captureOf(const PieceDraw& piece) const;

  const WalkScene& scene_;
  const ViewPlan& plan_;
  std::vector<SkyTable> skies_;  ///< of all captures the same, as a rule
  std::vector<std::size_t> skyOf_;
};

}  // namespace acentric
