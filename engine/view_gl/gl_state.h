#pragma once
/// The host's OpenGL state, kept safe while we draw in its context (a user interface draws in the same one).
/// Construction saves all that this folder changes and sets the values our passes start from; destruction
/// restores it.

#include <epoxy/gl.h>

#include <array>

namespace acentric {

class GlStateGuard {
 public:
  GlStateGuard();
  ~GlStateGuard();
  GlStateGuard(const GlStateGuard&) = delete;
  GlStateGuard& operator=(const GlStateGuard&) = delete;

  static constexpr int kTextureUnits = 5;     ///< units 0..4 may be bound by our passes
  static constexpr int kStorageBindings = 6;  ///< shader storage bindings 0..5 too
  static constexpr int kImageUnits = 2;       ///< and image units 0 and 1

 private:
  struct TextureUnit {
    GLint texture = 0, sampler = 0;
  };
  struct StorageBinding {
    GLint buffer = 0;
    GLint64 start = 0, size = 0;
  };
  struct ImageUnit {
    GLint texture = 0, level = 0, layered = 0, layer = 0, access = GL_READ_ONLY, format = GL_R8;
  };
  static constexpr std::array<GLenum, 13> kSwitches = {GL_BLEND,
                                                       GL_DEPTH_TEST,
                                                       GL_CULL_FACE,
                                                       GL_SCISSOR_TEST,
                                                       GL_STENCIL_TEST,
                                                       GL_DITHER,
                                                       GL_FRAMEBUFFER_SRGB,
                                                       GL_PROGRAM_POINT_SIZE,
                                                       GL_MULTISAMPLE,
                                                       GL_COLOR_LOGIC_OP,
                                                       GL_RASTERIZER_DISCARD,
                                                       GL_POLYGON_OFFSET_FILL,
                                                       GL_PRIMITIVE_RESTART};

  std::array<GLboolean, kSwitches.size()> switches_{};
  std::array<TextureUnit, kTextureUnits> units_{};
  std::array<StorageBinding, kStorageBindings> storage_{};
  std::array<ImageUnit, kImageUnits> images_{};
  std::array<GLint, 4> viewport_{};
  std::array<GLboolean, 4> colourMask_{};
  std::array<GLint, 6> blend_{};  // equations, then source and destination factors, of colour and alpha
  std::array<GLint, 2> polygonMode_{};
  std::array<GLfloat, 4> clearColour_{};
  std::array<GLint, 8> pixelStore_{};
  GLint drawFramebuffer_ = 0, readFramebuffer_ = 0, program_ = 0, vertexArray_ = 0, activeTexture_ = 0;
  GLint arrayBuffer_ = 0, storageBuffer_ = 0, packBuffer_ = 0, unpackBuffer_ = 0;
  GLint depthFunction_ = 0, cullMode_ = 0, frontFace_ = 0, pointOrigin_ = 0, provokingVertex_ = 0;
  GLint clipOrigin_ = 0, clipDepth_ = 0;
  std::array<GLint, 14> stencil_{};  // front, then back: function, reference, masks, operations
  GLfloat clearDepth_ = 1;
  GLboolean depthMask_ = GL_TRUE;
  std::array<GLfloat, 2> depthRange_{};
};

}  // namespace acentric
