#pragma once
/// Opens the cracks of the first cover for the second (view/cracks.h).

#include "engine/view_gl/frame_target.h"
#include "engine/view_gl/gl_program.h"

namespace acentric {

class CrackPass {
 public:
  explicit CrackPass(ProgramCache& programs);
  /// Once the first cover is drawn, with depths. From then on the second may be drawn in its cracks, before
  /// leastDepths().
  Status draw(const FrameTarget& target);
  /// R32F: depths of the framebuffer that are before what a crack shows; 0 where there is none.
  GLuint leastDepths() const { return least_.name(); }

 private:
  Status resize(int width, int height);

  ProgramCache& programs_;
  GlVertexArray noAttributes_;
  GlTexture least_;
  GlFramebuffer into_;
  int width_ = 0, height_ = 0;
};

}  // namespace acentric
