#include "engine/view_gl/pass_texture.h"

#include "engine/view_gl/gl_check.h"

namespace acentric {

Status PassTexture::resize(int width, int height) {
  if (width == width_ && height == height_) return {};
  width_ = height_ = 0;
  texture_ = GlTexture::make();
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, texture_.name());
  glTexStorage2D(GL_TEXTURE_2D, 1, format_, width, height);
  into_ = GlFramebuffer::make();
  glBindFramebuffer(GL_FRAMEBUFFER, into_.name());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.name(), 0);
  if (Status made = checkGl("making the texture of a pass"); !made) return made;
  width_ = width;
  height_ = height;
  return {};
}

void PassTexture::bindForDrawing() const {
  glBindFramebuffer(GL_FRAMEBUFFER, into_.name());
  glViewport(0, 0, width_, height_);
}

}  // namespace acentric
