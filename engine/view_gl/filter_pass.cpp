#include "engine/view_gl/filter_pass.h"

#include "engine/view_gl/gl_check.h"
#include "engine/view_gl/whole_picture.h"

namespace acentric {

FilterPass::FilterPass(ProgramCache& programs) : programs_(programs), noAttributes_(GlVertexArray::make()) {}

Status FilterPass::resize(int width, int height) {
  if (width == width_ && height == height_) return {};
  width_ = height_ = 0;
  filtered_ = GlTexture::make();
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, filtered_.name());
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA8, width, height);
  into_ = GlFramebuffer::make();
  glBindFramebuffer(GL_FRAMEBUFFER, into_.name());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, filtered_.name(), 0);
  if (Status made = checkGl("making the texture of the filter"); !made) return made;
  width_ = width;
  height_ = height;
  return {};
}

Status FilterPass::draw(const FrameTarget& target, bool localMirrors) {
  const Result<GlProgram*> program =
      programs_.get("whole_picture.vert", "filter.frag", localMirrors ? Defines{"LOCAL_MIRRORS"} : Defines{});
  if (!program) return tl::unexpected(program.error());
  if (Status sized = resize(target.width(), target.height()); !sized) return sized;
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_STENCIL_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_FRAMEBUFFER_SRGB);
  glBindFramebuffer(GL_FRAMEBUFFER, into_.name());
  glViewport(0, 0, width_, height_);
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
                     0, 0, width_, height_, 1);
  return checkGl("filtering");
}

}  // namespace acentric
