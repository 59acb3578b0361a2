#pragma once
/// An OpenGL context without a window, with a framebuffer whose pixels can be read.

#include <epoxy/gl.h>

#include <cstdlib>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "engine/view_gl/gl_renderer.h"
#include "ui/canvas_gl.h"

namespace acentric::ui::test {

/// What meshes are drawn with in tests, and as it is read back.
inline constexpr int kSize = 128;  ///< pixels of a side
inline constexpr ImU32 kRed = IM_COL32(255, 0, 0, 255), kGreen = IM_COL32(0, 255, 0, 255);
inline const glm::ivec3 kBlack(0), kPureRed(255, 0, 0), kPureGreen(0, 255, 0);

class Offscreen {
 public:
  Offscreen(int width, int height) : width_(width), height_(height) {
    setenv("LP_NUM_THREADS", "0", 0);  // Mesa's software driver: on a busy machine its threads mostly wait
    auto context = HeadlessContext::create();
    if (!context) return;
    context_ = std::move(*context);
    glGenFramebuffers(1, &framebuffer_);
    glGenRenderbuffers(1, &pixels_);
    glBindRenderbuffer(GL_RENDERBUFFER, pixels_);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, pixels_);
    glViewport(0, 0, width, height);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    clear();
  }
  ~Offscreen() {
    if (!context_) return;
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteRenderbuffers(1, &pixels_);
  }
  Offscreen(const Offscreen&) = delete;
  Offscreen& operator=(const Offscreen&) = delete;

  bool works() const { return context_ != nullptr; }
  CanvasTarget target() const { return {{0, 0}, {double(width_), double(height_)}}; }
  void clear() {
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
  }
  void read() {
    read_.resize(std::size_t(width_) * std::size_t(height_));
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, read_.data());
  }
  /// Of the last read(); y down, as in a window.
  glm::ivec3 at(int x, int y) const {
    return read_[std::size_t(height_ - 1 - y) * std::size_t(width_) + std::size_t(x)];
  }

 private:
  int width_, height_;
  std::unique_ptr<HeadlessContext> context_;
  GLuint framebuffer_ = 0, pixels_ = 0;
  std::vector<glm::u8vec4> read_;
};

}  // namespace acentric::ui::test
