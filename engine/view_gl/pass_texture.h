#pragma once
/// A texture that a pass draws a whole picture into, because what is read cannot be drawn into.

#include "engine/base/result.h"
#include "engine/view_gl/gl_object.h"

namespace acentric {

/// One level, read without filtering.
GlTexture pictureTexture(GLenum format, int width, int height);

class PassTexture {
 public:
  /// `format`: sized, one that can be drawn into. Keeps what it has when the size is the same.
  explicit PassTexture(GLenum format) : format_(format) {}
  Status resize(int width, int height);
  void bindForDrawing() const;

  GLuint name() const { return texture_.name(); }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  GLenum format_;
  GlTexture texture_;
  GlFramebuffer into_;
  int width_ = 0, height_ = 0;
};

}  // namespace acentric
