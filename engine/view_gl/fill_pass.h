#pragma once
/// Screen-space fill of the holes (view/hole_fill.h says what belongs there). On the graphics card by a
/// pyramid: each level halves the picture, keeping the farther of what is known; holes read the finest level
/// that knows something.

#include <vector>

#include "engine/view_gl/frame_target.h"
#include "engine/view_gl/gl_program.h"
#include "engine/view_gl/pass_texture.h"

namespace acentric {

class FillPass {
 public:
  explicit FillPass(ProgramCache& programs);
  /// Fills the holes of `target` and marks them kSourceInvented. `reach`: holes farther than about so many
  /// pixels from anything known stay open. Does nothing where there is no hole.
  Status draw(const FrameTarget& target, int reach);

 private:
  struct Level {
    PassTexture reduced{GL_RGBA16F}, expanded{GL_RGBA16F};
  };
  bool anyHole(const FrameTarget& target, GlProgram& counter) const;
  Status resize(int width, int height);

  ProgramCache& programs_;
  GlVertexArray noAttributes_;
  std::vector<Level> levels_;  ///< finest first: half the picture
  int width_ = 0, height_ = 0;
};

}  // namespace acentric
