#include "engine/view_gl/crack_pass.h"

#include "engine/view/cracks.h"
#include "engine/view_gl/gl_check.h"
#include "engine/view_gl/whole_picture.h"

namespace acentric {

CrackPass::CrackPass(ProgramCache& programs) : programs_(programs), noAttributes_(GlVertexArray::make()) {}

Status CrackPass::draw(const FrameTarget& target) {
  const Result<GlProgram*> find = programs_.get("whole_picture.vert", "cracks_find.frag", {});
  if (!find) return tl::unexpected(find.error());
  if (Status sized = least_.resize(target.width(), target.height()); !sized) return sized;
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_STENCIL_TEST);
  glDisable(GL_BLEND);
  least_.bindForDrawing();
  (*find)->use();
  glUniform1i((*find)->location("reach"), Cracks::kReach);
  glUniform1f((*find)->location("before"), Cracks::kBefore);
  drawWholePicture(**find, noAttributes_, {{"depths", target.depths()}});
  return checkGl("finding cracks");
}

}  // namespace acentric
