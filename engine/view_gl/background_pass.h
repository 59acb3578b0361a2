#pragma once
/// The background: where no capture has rows (view/background.h), in views that show such a direction, and
/// where captures show it (view/captured_background.h). Drawn before the captures' samples.

#include "engine/view/background.h"
#include "engine/view/view_plan.h"
#include "engine/view_gl/capture_residency.h"
#include "engine/view_gl/frame_target.h"
#include "engine/view_gl/gl_program.h"

namespace acentric {

class BackgroundPass {
 public:
  BackgroundPass(ProgramCache& programs, CaptureResidency& captures);
  Status draw(const WalkScene& scene, const ViewPlan& plan, const PerspectiveView& view,
              const FrameTarget& target);

 private:
  Status drawCaptured(const WalkScene& scene, const PieceDraw& piece, const PerspectiveView& view);
  Result<GlProgram*> program(const Defines& defines, const PerspectiveView& view, const Sky& sky,
                             float exposure, PixelSource source);

  ProgramCache& programs_;
  CaptureResidency& captures_;
  GlVertexArray noAttributes_;
  GlBuffer columnRuns_;
  std::vector<glm::uvec2> runs_;  // kept between pieces for its memory
};

}  // namespace acentric
