#include "engine/view_gl/gl_state.h"

namespace acentric {
namespace {

constexpr std::array<GLenum, 8> kPixelStore = {
    GL_PACK_ALIGNMENT,   GL_PACK_ROW_LENGTH,   GL_PACK_SKIP_ROWS,   GL_PACK_SKIP_PIXELS,
    GL_UNPACK_ALIGNMENT, GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS};
constexpr std::array<GLenum, 6> kBlend = {GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA, GL_BLEND_SRC_RGB,
                                          GL_BLEND_DST_RGB,      GL_BLEND_SRC_ALPHA,      GL_BLEND_DST_ALPHA};

constexpr std::array<GLenum, 14> kStencil = {GL_STENCIL_FUNC,
                                             GL_STENCIL_REF,
                                             GL_STENCIL_VALUE_MASK,
                                             GL_STENCIL_WRITEMASK,
                                             GL_STENCIL_FAIL,
                                             GL_STENCIL_PASS_DEPTH_FAIL,
                                             GL_STENCIL_PASS_DEPTH_PASS,
                                             GL_STENCIL_BACK_FUNC,
                                             GL_STENCIL_BACK_REF,
                                             GL_STENCIL_BACK_VALUE_MASK,
                                             GL_STENCIL_BACK_WRITEMASK,
                                             GL_STENCIL_BACK_FAIL,
                                             GL_STENCIL_BACK_PASS_DEPTH_FAIL,
                                             GL_STENCIL_BACK_PASS_DEPTH_PASS};

GLint integer(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

GLuint name(GLint value) { return static_cast<GLuint>(value); }
GLenum token(GLint value) { return static_cast<GLenum>(value); }

void turn(GLenum what, GLboolean on) {
  if (on == GL_TRUE)
    glEnable(what);
  else
    glDisable(what);
}

}  // namespace

GlStateGuard::GlStateGuard() {
  for (std::size_t i = 0; i < kSwitches.size(); ++i) switches_[i] = glIsEnabled(kSwitches[i]);
  activeTexture_ = integer(GL_ACTIVE_TEXTURE);
  for (std::size_t i = 0; i < units_.size(); ++i) {
    glActiveTexture(GL_TEXTURE0 + GLenum(i));
    units_[i] = {integer(GL_TEXTURE_BINDING_2D), integer(GL_SAMPLER_BINDING)};
  }
  storageBuffer_ = integer(GL_SHADER_STORAGE_BUFFER_BINDING);
  for (std::size_t i = 0; i < storage_.size(); ++i) {
    glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, GLuint(i), &storage_[i].buffer);
    glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_START, GLuint(i), &storage_[i].start);
    glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_SIZE, GLuint(i), &storage_[i].size);
  }
  for (std::size_t i = 0; i < images_.size(); ++i) {
    ImageUnit& unit = images_[i];
    glGetIntegeri_v(GL_IMAGE_BINDING_NAME, GLuint(i), &unit.texture);
    glGetIntegeri_v(GL_IMAGE_BINDING_LEVEL, GLuint(i), &unit.level);
    glGetIntegeri_v(GL_IMAGE_BINDING_LAYERED, GLuint(i), &unit.layered);
    glGetIntegeri_v(GL_IMAGE_BINDING_LAYER, GLuint(i), &unit.layer);
    glGetIntegeri_v(GL_IMAGE_BINDING_ACCESS, GLuint(i), &unit.access);
    glGetIntegeri_v(GL_IMAGE_BINDING_FORMAT, GLuint(i), &unit.format);
  }
  glGetIntegerv(GL_VIEWPORT, viewport_.data());
  glGetFloatv(GL_DEPTH_RANGE, depthRange_.data());
  glGetBooleanv(GL_COLOR_WRITEMASK, colourMask_.data());
  glGetBooleanv(GL_DEPTH_WRITEMASK, &depthMask_);
  for (std::size_t i = 0; i < kBlend.size(); ++i) blend_[i] = integer(kBlend[i]);
  for (std::size_t i = 0; i < kPixelStore.size(); ++i) pixelStore_[i] = integer(kPixelStore[i]);
  glGetIntegerv(GL_POLYGON_MODE, polygonMode_.data());
  glGetFloatv(GL_COLOR_CLEAR_VALUE, clearColour_.data());
  glGetFloatv(GL_DEPTH_CLEAR_VALUE, &clearDepth_);
  drawFramebuffer_ = integer(GL_DRAW_FRAMEBUFFER_BINDING);
  readFramebuffer_ = integer(GL_READ_FRAMEBUFFER_BINDING);
  program_ = integer(GL_CURRENT_PROGRAM);
  vertexArray_ = integer(GL_VERTEX_ARRAY_BINDING);
  arrayBuffer_ = integer(GL_ARRAY_BUFFER_BINDING);
  packBuffer_ = integer(GL_PIXEL_PACK_BUFFER_BINDING);
  unpackBuffer_ = integer(GL_PIXEL_UNPACK_BUFFER_BINDING);
  depthFunction_ = integer(GL_DEPTH_FUNC);
  cullMode_ = integer(GL_CULL_FACE_MODE);
  frontFace_ = integer(GL_FRONT_FACE);
  pointOrigin_ = integer(GL_POINT_SPRITE_COORD_ORIGIN);
  provokingVertex_ = integer(GL_PROVOKING_VERTEX);
  clipOrigin_ = integer(GL_CLIP_ORIGIN);
  clipDepth_ = integer(GL_CLIP_DEPTH_MODE);
  for (std::size_t i = 0; i < kStencil.size(); ++i) stencil_[i] = integer(kStencil[i]);

  for (GLenum what : kSwitches) glDisable(what);
  glEnable(GL_PROGRAM_POINT_SIZE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_GREATER);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glStencilMask(0xff);
  glStencilFunc(GL_ALWAYS, 1, 0xff);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  glDepthRange(0, 1);
  glClearDepth(1);
  glCullFace(GL_BACK);
  glFrontFace(GL_CCW);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glProvokingVertex(GL_LAST_VERTEX_CONVENTION);
  glBlendEquation(GL_FUNC_ADD);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  for (GLenum what : kPixelStore)
    glPixelStorei(what, what == GL_PACK_ALIGNMENT || what == GL_UNPACK_ALIGNMENT ? 1 : 0);
}

GlStateGuard::~GlStateGuard() {
  for (std::size_t i = 0; i < kSwitches.size(); ++i) turn(kSwitches[i], switches_[i]);
  for (std::size_t i = 0; i < units_.size(); ++i) {
    glActiveTexture(GL_TEXTURE0 + GLenum(i));
    // A resize may have deleted the texture that the host had bound.
    const bool alive = units_[i].texture == 0 || glIsTexture(name(units_[i].texture)) == GL_TRUE;
    glBindTexture(GL_TEXTURE_2D, alive ? name(units_[i].texture) : 0);
    glBindSampler(GLuint(i), name(units_[i].sampler));
  }
  glActiveTexture(token(activeTexture_));
  for (std::size_t i = 0; i < storage_.size(); ++i) {
    const StorageBinding& binding = storage_[i];
    if (binding.buffer != 0 && binding.size > 0)
      glBindBufferRange(GL_SHADER_STORAGE_BUFFER, GLuint(i), name(binding.buffer), GLintptr(binding.start),
                        GLsizeiptr(binding.size));
    else
      glBindBufferBase(GL_SHADER_STORAGE_BUFFER, GLuint(i), name(binding.buffer));
  }
  for (std::size_t i = 0; i < images_.size(); ++i) {
    const ImageUnit& unit = images_[i];
    glBindImageTexture(GLuint(i), name(unit.texture), unit.level, GLboolean(unit.layered != 0), unit.layer,
                       token(unit.access), token(unit.format));
  }
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, name(storageBuffer_));
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, name(drawFramebuffer_));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, name(readFramebuffer_));
  glUseProgram(name(program_));
  glBindVertexArray(name(vertexArray_));
  glBindBuffer(GL_ARRAY_BUFFER, name(arrayBuffer_));
  glBindBuffer(GL_PIXEL_PACK_BUFFER, name(packBuffer_));
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, name(unpackBuffer_));
  for (std::size_t i = 0; i < kPixelStore.size(); ++i) glPixelStorei(kPixelStore[i], pixelStore_[i]);
  glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
  glDepthRangef(depthRange_[0], depthRange_[1]);
  glColorMask(colourMask_[0], colourMask_[1], colourMask_[2], colourMask_[3]);
  glDepthMask(depthMask_);
  glBlendEquationSeparate(token(blend_[0]), token(blend_[1]));
  glBlendFuncSeparate(token(blend_[2]), token(blend_[3]), token(blend_[4]), token(blend_[5]));
  glPolygonMode(GL_FRONT_AND_BACK, token(polygonMode_[0]));
  glClearColor(clearColour_[0], clearColour_[1], clearColour_[2], clearColour_[3]);
  glClearDepthf(clearDepth_);
  glDepthFunc(token(depthFunction_));
  glCullFace(token(cullMode_));
  glFrontFace(token(frontFace_));
  glPointParameteri(GL_POINT_SPRITE_COORD_ORIGIN, pointOrigin_);
  glProvokingVertex(token(provokingVertex_));
  glClipControl(token(clipOrigin_), token(clipDepth_));
  for (std::size_t face : {0u, 7u}) {
    const GLenum side = face == 0 ? GL_FRONT : GL_BACK;
    glStencilFuncSeparate(side, token(stencil_[face]), stencil_[face + 1], name(stencil_[face + 2]));
    glStencilMaskSeparate(side, name(stencil_[face + 3]));
    glStencilOpSeparate(side, token(stencil_[face + 4]), token(stencil_[face + 5]),
                        token(stencil_[face + 6]));
  }
}

}  // namespace acentric
