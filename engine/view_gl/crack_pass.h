#pragma once
/// Finds the cracks of the first cover, where the second may show (view/cracks.h).

#include "engine/view_gl/frame_target.h"
#include "engine/view_gl/gl_program.h"
#include "engine/view_gl/pass_texture.h"

namespace acentric {

class CrackPass {
 public:
  explicit CrackPass(ProgramCache& programs);
  /// Once the first cover is drawn, with depths.
  Status draw(const FrameTarget& target);
  /// R32F: depths of the framebuffer that are before what a crack shows; 0 where there is none.
  GLuint leastDepths() const { return least_.name(); }

 private:
  ProgramCache& programs_;
  GlVertexArray noAttributes_;
  PassTexture least_{GL_R32F};
};

}  // namespace acentric
