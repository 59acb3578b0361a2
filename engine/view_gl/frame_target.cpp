#include "engine/view_gl/frame_target.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/view_gl/gl_check.h"
#include "engine/view_gl/pass_texture.h"

namespace acentric {
namespace {

Status complete() {
  const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status == GL_FRAMEBUFFER_COMPLETE) return {};
  return fail(ErrorKind::unsupported,
              fmt::format("this driver does not draw into RGBA8 + R16UI + DEPTH32F_STENCIL8 (status {:#x}): "
                          "use a CPU renderer",
                          status),
              "OpenGL");
}

/// Rows from bottom-up to top-down.
template <class Pixel>
void flipRows(Image<Pixel>& image) {
  for (int y = 0; y < image.height / 2; ++y) {
    Pixel* top = &image.at(0, y);
    std::swap_ranges(top, top + image.width, &image.at(0, image.height - 1 - y));
  }
}

}  // namespace

Status FrameTarget::resize(int width, int height) {
  if (width == width_ && height == height_) return {};
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (width > largest || height > largest)
    return fail(ErrorKind::tooLarge,
                fmt::format("{}x{} pixels: this driver draws at most {} on a side", width, height, largest),
                "OpenGL");

  width_ = height_ = 0;  // nothing usable until all is made
  withMirrors_.reset();
  mirrors_.reset();
  glActiveTexture(GL_TEXTURE0);
  colour_ = pictureTexture(GL_RGBA8, width, height);
  colourSrgb_ = GlTexture::make();
  glTextureView(colourSrgb_.name(), GL_TEXTURE_2D, colour_.name(), GL_SRGB8_ALPHA8, 0, 1, 0, 1);
  source_ = pictureTexture(GL_R16UI, width, height);
  depth_ = pictureTexture(GL_DEPTH32F_STENCIL8, width, height);
  if (Status made = checkGl("making the frame's textures"); !made) return made;

  draw_ = GlFramebuffer::make();
  attachPicture(draw_);
  constexpr std::array<GLenum, 2> kTargets = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  glDrawBuffers(GLsizei(kTargets.size()), kTargets.data());
  if (Status drawable = complete(); !drawable) return drawable;

  read_ = GlFramebuffer::make();
  glBindFramebuffer(GL_FRAMEBUFFER, read_.name());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_.name(), 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, source_.name(), 0);
  if (Status readable = complete(); !readable) return readable;
  if (Status made = checkGl("making the framebuffer"); !made) return made;
  width_ = width;
  height_ = height;
  return {};
}

void FrameTarget::attachPicture(const GlFramebuffer& framebuffer) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colourSrgb_.name(), 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, source_.name(), 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D, depth_.name(), 0);
}

void FrameTarget::bindForDrawing() const {
  glBindFramebuffer(GL_FRAMEBUFFER, draw_.name());
  glViewport(0, 0, width_, height_);
}

Status FrameTarget::beginMirrors() {
  if (!withMirrors_) {
    glActiveTexture(GL_TEXTURE0);
    mirrors_ = pictureTexture(GL_R8UI, width_, height_);
    withMirrors_ = GlFramebuffer::make();
    attachPicture(withMirrors_);
    constexpr std::array<GLenum, 3> kTargets = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1,
                                                GL_COLOR_ATTACHMENT2};
    glFramebufferTexture2D(GL_FRAMEBUFFER, kTargets[2], GL_TEXTURE_2D, mirrors_.name(), 0);
    glDrawBuffers(GLsizei(kTargets.size()), kTargets.data());
    if (Status drawable = complete(); !drawable) return drawable;
  }
  glBindFramebuffer(GL_FRAMEBUFFER, withMirrors_.name());
  glViewport(0, 0, width_, height_);
  constexpr std::array<GLuint, 4> kNothing = {0, 0, 0, 0};
  glClearBufferuiv(GL_COLOR, 2, kNothing.data());
  return checkGl("making what mirrors are marked in");
}

void FrameTarget::begin() const {
  bindForDrawing();
  constexpr std::array<GLfloat, 4> kNoColour = {0, 0, 0, 0};
  constexpr std::array<GLuint, 4> kNoSource = {kSourceHole, 0, 0, 0};
  glClearBufferfv(GL_COLOR, 0, kNoColour.data());
  glClearBufferuiv(GL_COLOR, 1, kNoSource.data());
  glClearBufferfi(GL_DEPTH_STENCIL, 0, 0.0f, 0);
}

Frame FrameTarget::read() const {
  Frame frame;
  if (width_ == 0) return frame;
  frame.colour = ColourImage(width_, height_);
  frame.source = Image<PixelSource>(width_, height_);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, read_.name());
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, frame.colour.pixels.data());
  glReadBuffer(GL_COLOR_ATTACHMENT1);
  glReadPixels(0, 0, width_, height_, GL_RED_INTEGER, GL_UNSIGNED_SHORT, frame.source.pixels.data());
  flipRows(frame.colour);
  flipRows(frame.source);
  for (std::size_t i = 0; i < frame.source.pixels.size(); ++i)
    frame.colour.pixels[i].a = frame.source.pixels[i] == kSourceHole ? 0 : 255;
  return frame;
}

}  // namespace acentric
