#pragma once
/// The background where no capture has rows (view/background.h). Drawn before the captures, and only in views
/// that show such a direction.

#include "engine/view/background.h"
#include "engine/view_gl/frame_target.h"
#include "engine/view_gl/gl_program.h"

namespace acentric {

class BackgroundPass {
 public:
  explicit BackgroundPass(ProgramCache& programs);
  Status draw(const WalkScene& scene, const PerspectiveView& view, const FrameTarget& target);

 private:
  ProgramCache& programs_;
  GlVertexArray noAttributes_;
};

}  // namespace acentric
