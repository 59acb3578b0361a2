#pragma once
/// OpenGL names that delete themselves. Move only; 0 = none. Made and destroyed with the context current.

#include <epoxy/gl.h>

#include <utility>

namespace acentric {

template <class Kind>
class GlObject {
 public:
  GlObject() = default;
  static GlObject make() {
    GlObject object;
    object.name_ = Kind::make();
    return object;
  }
  static GlObject adopt(GLuint name) {
    GlObject object;
    object.name_ = name;
    return object;
  }
  ~GlObject() { reset(); }
  GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    if (this != &other) {
      reset();
      name_ = std::exchange(other.name_, 0);
    }
    return *this;
  }
  GlObject(const GlObject&) = delete;
  GlObject& operator=(const GlObject&) = delete;

  GLuint name() const { return name_; }
  explicit operator bool() const { return name_ != 0; }
  void reset() {
    if (name_ != 0) Kind::destroy(name_);
    name_ = 0;
  }

 private:
  GLuint name_ = 0;
};

struct GlBufferKind {
  static GLuint make() {
    GLuint name = 0;
    glGenBuffers(1, &name);
    return name;
  }
  static void destroy(GLuint name) { glDeleteBuffers(1, &name); }
};
struct GlTextureKind {
  static GLuint make() {
    GLuint name = 0;
    glGenTextures(1, &name);
    return name;
  }
  static void destroy(GLuint name) { glDeleteTextures(1, &name); }
};
struct GlSamplerKind {
  static GLuint make() {
    GLuint name = 0;
    glGenSamplers(1, &name);
    return name;
  }
  static void destroy(GLuint name) { glDeleteSamplers(1, &name); }
};
struct GlFramebufferKind {
  static GLuint make() {
    GLuint name = 0;
    glGenFramebuffers(1, &name);
    return name;
  }
  static void destroy(GLuint name) { glDeleteFramebuffers(1, &name); }
};
struct GlQueryKind {
  static GLuint make() {
    GLuint name = 0;
    glGenQueries(1, &name);
    return name;
  }
  static void destroy(GLuint name) { glDeleteQueries(1, &name); }
};
struct GlVertexArrayKind {
  static GLuint make() {
    GLuint name = 0;
    glGenVertexArrays(1, &name);
    return name;
  }
  static void destroy(GLuint name) { glDeleteVertexArrays(1, &name); }
};
struct GlProgramKind {
  static GLuint make() { return glCreateProgram(); }
  static void destroy(GLuint name) { glDeleteProgram(name); }
};
struct GlShaderKind {
  static GLuint make() { return 0; }  // a shader needs its stage: use adopt(glCreateShader(stage))
  static void destroy(GLuint name) { glDeleteShader(name); }
};

using GlBuffer = GlObject<GlBufferKind>;
using GlTexture = GlObject<GlTextureKind>;
using GlSampler = GlObject<GlSamplerKind>;
using GlFramebuffer = GlObject<GlFramebufferKind>;
using GlQuery = GlObject<GlQueryKind>;
using GlVertexArray = GlObject<GlVertexArrayKind>;
using GlProgramName = GlObject<GlProgramKind>;
using GlShader = GlObject<GlShaderKind>;

}  // namespace acentric
