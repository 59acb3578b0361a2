#include "ui/gl_names.h"

#include <epoxy/gl.h>

#include <array>
#include <string_view>

#include "ui/shader_sources.h"

namespace acentric::ui {

template <GlKind kind>
unsigned GlName<kind>::made() {
  if (name_ != 0) return name_;
  if constexpr (kind == GlKind::buffer) glGenBuffers(1, &name_);
  if constexpr (kind == GlKind::texture) glGenTextures(1, &name_);
  if constexpr (kind == GlKind::vertexArray) glGenVertexArrays(1, &name_);
  if constexpr (kind == GlKind::program) name_ = glCreateProgram();
  if constexpr (kind == GlKind::renderbuffer) glGenRenderbuffers(1, &name_);
  if constexpr (kind == GlKind::framebuffer) glGenFramebuffers(1, &name_);
  return name_;
}

template <GlKind kind>
void GlName<kind>::reset() {
  if (name_ == 0) return;
  if constexpr (kind == GlKind::buffer) glDeleteBuffers(1, &name_);
  if constexpr (kind == GlKind::texture) glDeleteTextures(1, &name_);
  if constexpr (kind == GlKind::vertexArray) glDeleteVertexArrays(1, &name_);
  if constexpr (kind == GlKind::program) glDeleteProgram(name_);
  if constexpr (kind == GlKind::renderbuffer) glDeleteRenderbuffers(1, &name_);
  if constexpr (kind == GlKind::framebuffer) glDeleteFramebuffers(1, &name_);
  name_ = 0;
}

template class GlName<GlKind::buffer>;
template class GlName<GlKind::texture>;
template class GlName<GlKind::vertexArray>;
template class GlName<GlKind::program>;
template class GlName<GlKind::renderbuffer>;
template class GlName<GlKind::framebuffer>;

namespace {

std::string_view sourceOf(std::string_view file) {
  for (const ShaderSource& source : shaderSources())
    if (source.name == file) return source.text;
  return {};
}

/// 0 and the driver's words if it does not compile.
GLuint compiled(GLenum stage, const char* file, bool withCanvas, std::string& problem) {
  const std::string text = "#version 330 core\n" +
                           std::string(withCanvas ? sourceOf("canvas.glsl") : std::string_view()) +
                           std::string(sourceOf(file));
  const GLuint shader = glCreateShader(stage);
  const char* start = text.c_str();
  glShaderSource(shader, 1, &start, nullptr);
  glCompileShader(shader);
  GLint good = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == GL_TRUE) return shader;
  std::array<char, 2048> words{};
  glGetShaderInfoLog(shader, GLsizei(words.size() - 1), nullptr, words.data());
  problem = std::string(file) + ": " + words.data();
  glDeleteShader(shader);
  return 0;
}

}  // namespace

void GlProgram::compile() {
  const GLuint vertex = compiled(GL_VERTEX_SHADER, files_.first, true, problem_);
  const GLuint fragment = compiled(GL_FRAGMENT_SHADER, files_.second, false, problem_);
  if (vertex != 0 && fragment != 0) {
    const GLuint program = program_.made();
    glAttachShader(program, vertex);
    glAttachShader(program, fragment);
    glLinkProgram(program);
    GLint good = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &good);
    if (good != GL_TRUE) {
      std::array<char, 2048> words{};
      glGetProgramInfoLog(program, GLsizei(words.size() - 1), nullptr, words.data());
      problem_ = std::string(files_.first) + " with " + files_.second + ": " + words.data();
      program_.reset();
    }
  }
  glDeleteShader(vertex);
  glDeleteShader(fragment);
}

bool GlProgram::use() {
  if (program_.name() == 0 && problem_.empty()) compile();
  if (program_.name() != 0) glUseProgram(program_.name());
  return program_.name() != 0;
}

int GlProgram::location(const char* uniform) const { return glGetUniformLocation(program_.name(), uniform); }
void GlProgram::set(const char* uniform, int value) const { glUniform1i(location(uniform), value); }
void GlProgram::set(const char* uniform, float value) const { glUniform1f(location(uniform), value); }
void GlProgram::set(const char* uniform, float x, float y) const { glUniform2f(location(uniform), x, y); }
void GlProgram::set(const char* uniform, float x, float y, float z, float w) const {
  glUniform4f(location(uniform), x, y, z, w);
}

}  // namespace acentric::ui
