#include "engine/view_gl/gl_check.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>

namespace acentric {
namespace {

// A lost context may answer with an error for ever.
constexpr int kMostErrors = 64;

const char* nameOfError(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
      return "GL_OUT_OF_MEMORY";
    default:
      return "an unknown OpenGL error";
  }
}

/// The last message of type error in the context's debug log (filled when no callback is installed), or "".
std::string debugMessage() {
  GLint flags = 0;
  glGetIntegerv(GL_CONTEXT_FLAGS, &flags);
  if ((flags & GL_CONTEXT_FLAG_DEBUG_BIT) == 0) return {};
  std::string last;
  std::array<char, 2048> text{};
  for (int n = 0; n < kMostErrors; ++n) {
    GLenum source = 0, type = 0, severity = 0;
    GLuint id = 0;
    GLsizei length = 0;
    if (glGetDebugMessageLog(1, GLsizei(text.size()), &source, &type, &id, &severity, &length, text.data()) ==
        0)
      break;
    if (type == GL_DEBUG_TYPE_ERROR) last = text.data();
  }
  return last;
}

}  // namespace

void forgetGlErrors() {
  for (int n = 0; n < kMostErrors && glGetError() != GL_NO_ERROR; ++n) {
  }
}

Status checkGl(const char* doing) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return {};
  forgetGlErrors();
  const std::string words = debugMessage();
  if (error == GL_OUT_OF_MEMORY)
    return fail(ErrorKind::outOfSpace,
                fmt::format("out of graphics memory while {}: use smaller captures or a CPU renderer", doing),
                "OpenGL");
  return fail(ErrorKind::internal,
              fmt::format("{} while {}{}{}", nameOfError(error), doing, words.empty() ? "" : ": ", words),
              "OpenGL");
}

}  // namespace acentric
