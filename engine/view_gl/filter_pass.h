#pragma once
/// The last step of Reconstruction::filtered on OpenGL: each pixel's colour from the samples in it and in the
/// eight pixels around it (view/pixel_filter.h), before local geometry is drawn.

#include "engine/view_gl/frame_target.h"
#include "engine/view_gl/gl_program.h"
#include "engine/view_gl/pass_texture.h"

namespace acentric {

class FilterPass {
 public:
  explicit FilterPass(ProgramCache& programs);
  /// `target` has been drawn with places. `localMirrors`: mirrors among the local geometry are marked; what
  /// other local geometry hides beside them is not mixed in (as in view/warp.cpp).
  Status draw(const FrameTarget& target, bool localMirrors);

 private:
  ProgramCache& programs_;
  GlVertexArray noAttributes_;
  PassTexture filtered_{GL_RGBA8};
};

}  // namespace acentric
