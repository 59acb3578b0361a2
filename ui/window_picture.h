#pragma once
/// The picture of the window, kept from frame to frame so that a frame draws only what changed. Needs the
/// window's context; main thread only.

#include <imgui.h>

#include "ui/colour.h"
#include "ui/damage.h"
#include "ui/gl_names.h"

namespace acentric::ui {

class WindowPicture {
 public:
  /// Draws what changed. `data` is clipped to it. False: nothing did.
  bool draw(ImDrawData& data, const Colour& background);
  /// Copies all of it to the framebuffer that the window shows.
  void show() const;
  /// Draw everything with the next frame.
  void forget() { damage_.forget(); }
  /// That holds the picture; 0 before the first frame.
  unsigned framebuffer() const { return framebuffer_.name(); }

 private:
  void resize(const glm::ivec2& size);

  Damage damage_;
  GlName<GlKind::framebuffer> framebuffer_;
  GlName<GlKind::renderbuffer> pixels_;
  glm::ivec2 size_{0};
  ImU32 background_ = 0;
};

}  // namespace acentric::ui
