#include "engine/view_gl/filter_pass.h"

#include "engine/view_gl/gl_check.h"
#include "engine/view_gl/whole_picture.h"

namespace acentric {

FilterPass::FilterPass(ProgramCache& programs) : programs_(programs), noAttributes_(GlVertexArray::make()) {}

Status FilterPass::draw(const FrameTarget& target, bool localMirrors) {
  const Result<GlProgram*> program =
      programs_.get("whole_picture.vert", "filter.frag", localMirrors ? Defines{"LOCAL_MIRRORS"} : Defines{});
  if (!program) return tl::unexpected(program.error());
  if (Status sized = filtered_.resize(target.width(), target.height()); !sized) return sized;
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_STENCIL_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_FRAMEBUFFER_SRGB);
  filtered_.bindForDrawing();
  (*program)->use();
  glUniform1ui((*program)->location("hole"), kSourceHole);
  const TextureInput codes{"codes", target.colourCodes()}, sources{"sources", target.sources()},
      places{"places", target.places()};
  if (localMirrors)
    drawWholePicture(**program, noAttributes_,
                     {codes, sources, places, {"mirrors", target.mirrors()}, {"depths", target.depths()}});
  else
    drawWholePicture(**program, noAttributes_, {codes, sources, places});
  glCopyImageSubData(filtered_.name(), GL_TEXTURE_2D, 0, 0, 0, 0, target.colourCodes(), GL_TEXTURE_2D, 0, 0,
                     0, 0, target.width(), target.height(), 1);
  return checkGl("filtering");
}

}  // namespace acentric
