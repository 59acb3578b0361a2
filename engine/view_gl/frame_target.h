#pragma once
/// The framebuffer that a frame is drawn into: colour, source (camera + 1 and the special values of
/// view/frame.h) and depth. The colour texture has two views of one storage: RGBA8, which shows the codes as
/// they are (windows, reading back, opaque samples), and SRGB8_ALPHA8, attached, through which
/// GL_FRAMEBUFFER_SRGB makes blending linear.

#include "engine/base/result.h"
#include "engine/view/frame.h"
#include "engine/view_gl/gl_object.h"

namespace acentric {

/// The stencil: 0 in holes; kReflection where a mirror's reflection was drawn, if there are mirrors among the
/// local geometry.
enum StencilBits : GLint { kCovered = 1, kReflection = 8 };

class FrameTarget {
 public:
  /// Keeps what it has when the size is the same.
  Status resize(int width, int height);
  /// Binds for drawing into colour and source, and clears both (holes) and the depth.
  void begin() const;
  void bindForDrawing() const;
  /// Binds for drawing with one thing more, which is cleared: which mirror each pixel shows.
  Status beginMirrors();
  /// Colours and sources as they stand, row 0 on top. Alpha is 255 wherever there is a source.
  Frame read() const;

  int width() const { return width_; }
  int height() const { return height_; }
  GLuint colourCodes() const { return colour_.name(); }  ///< RGBA8 view
  GLuint depths() const { return depth_.name(); }        ///< DEPTH32F_STENCIL8
  GLuint sources() const { return source_.name(); }      ///< R16UI
  GLuint mirrors() const { return mirrors_.name(); }     ///< R8UI, 0 = no mirror

 private:
  void attachPicture(const GlFramebuffer& framebuffer) const;

  int width_ = 0;
  int height_ = 0;
  GlTexture colour_;
  GlTexture colourSrgb_;
  GlTexture source_;
  GlTexture depth_;
  GlFramebuffer draw_;
  GlFramebuffer read_;
  GlTexture mirrors_;  ///< made when first used
  GlFramebuffer withMirrors_;
};

}  // namespace acentric
