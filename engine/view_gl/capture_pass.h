#pragma once
/// Draws what a view plan takes from captures: the pieces of the first cover, those of the second where
/// nothing of the first lies, and in its cracks; then what mirrors show. As points in order, or with a depth
/// test.

#include "engine/view_gl/crack_pass.h"
#include "engine/view_gl/frame_target.h"
#include "engine/view_gl/point_pass.h"

namespace acentric {

class CapturePass {
 public:
  CapturePass(ProgramCache& programs, CaptureResidency& captures);
  /// Into `target`, which begin() has cleared. Writes depth only where a later pass reads it. Counts images
  /// and samples in `stats`.
  Status draw(const WalkScene& scene, const ViewPlan& plan, const PerspectiveView& view,
              const ViewSettings& settings, FrameTarget& target, FrameStats& stats);
  /// What mirrors show, onto the pixels that `target` says belong to them. `localMirrors`: some are local
  /// geometry; the stencil then says what was drawn.
  Status drawReflections(const WalkScene& scene, const ViewPlan& plan, const PerspectiveView& view,
                         const ViewSettings& settings, bool localMirrors, FrameTarget& target,
                         FrameStats& stats);

 private:
  PointPass points_;
  CrackPass cracks_;
};

}  // namespace acentric
