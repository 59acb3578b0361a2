#pragma once
/// Local geometry over the background, shaded per pixel like view/local_shading.h: opaque and alpha-tested
/// triangles with a depth test among themselves, then the clear ones, far to near. Shader variants hold only
/// the effects that a material has and the effect plan calls for.

#include "engine/geometry/perspective_view.h"
#include "engine/view/frame.h"
#include "engine/view/local_shading.h"
#include "engine/view_gl/frame_target.h"
#include "engine/view_gl/gl_program.h"
#include "engine/view_gl/local_buffers.h"
#include "engine/view_gl/texture_cache.h"

namespace acentric {

class LocalPass {
 public:
  LocalPass(ProgramCache& programs, TextureCache& textures);

  /// Before patches, of buffers with mirrors: what is opaque leaves its depth, and its mirror
  /// or none to `target`; where a mirror is nearest the pixel has no source any more.
  Status markMirrors(const WalkScene& scene, const PerspectiveView& view, FrameTarget& target,
                     LocalBuffers& buffers);
  /// `marked`: after markMirrors and the reflections, which stay.
  Status drawOpaque(const WalkScene& scene, const PerspectiveView& view, const FrameTarget& target,
                    LocalBuffers& buffers, bool marked);
  /// After the filling of holes: glass needs something behind it.
  Status drawClear(const WalkScene& scene, const PerspectiveView& view, const FrameTarget& target,
                   LocalBuffers& buffers);

 private:
  enum class Draws { looks, mirrorNumber };
  /// Binds the program, uniforms and textures of a batch.
  Status prepare(const WalkScene& scene, const PerspectiveView& view, const LocalBuffers& buffers,
                 const LocalBatch& batch, const LocalMaterial& material, Draws draws);
  Status bindTexture(GlProgram& program, const char* uniform, int unit, const WalkScene& scene,
                     const TextureUse& use);

  ProgramCache& programs_;
  TextureCache& textures_;
};

}  // namespace acentric
