#include "ui/window_picture.h"

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>

#include <cmath>

namespace acentric::ui {

void WindowPicture::resize(const glm::ivec2& size) {
  if (size == size_) return;
  size_ = size;
  glBindRenderbuffer(GL_RENDERBUFFER, pixels_.made());
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, size.x, size.y);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.made());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, pixels_.name());
}

bool WindowPicture::draw(ImDrawData& data, const Colour& background) {
  if (background_ != background.packed()) damage_.forget();
  background_ = background.packed();
  const std::vector<PixelRect> changed = damage_.update(data);
  if (changed.empty()) return false;
  resize({std::lround(data.DisplaySize.x * data.FramebufferScale.x),
          std::lround(data.DisplaySize.y * data.FramebufferScale.y)});
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glClearColor(background.r, background.g, background.b, 1);
  glEnable(GL_SCISSOR_TEST);
  for (const PixelRect& rect : changed) {
    glScissor(rect.min.x, size_.y - rect.max.y, rect.max.x - rect.min.x, rect.max.y - rect.min.y);
    glClear(GL_COLOR_BUFFER_BIT);
  }
  glDisable(GL_SCISSOR_TEST);
  clipTo(data, changed);
  ImGui_ImplOpenGL3_RenderDrawData(&data);
  return true;
}

void WindowPicture::show() const {
  glDisable(GL_SCISSOR_TEST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.name());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glBlitFramebuffer(0, 0, size_.x, size_.y, 0, 0, size_.x, size_.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace acentric::ui
