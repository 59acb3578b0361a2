#include "engine/view_gl/pass_texture.h"

#include "engine/view_gl/gl_check.h"

namespace acentric {

GlTexture pictureTexture(GLenum format, int width, int height) {
  GlTexture texture = GlTexture::make();
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, texture.name());
  glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
  // One level without mipmaps: the default filter would make the texture incomplete.
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

Status PassTexture::resize(int width, int height) {
  if (width == width_ && height == height_) return {};
  width_ = height_ = 0;
  texture_ = pictureTexture(format_, width, height);
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
