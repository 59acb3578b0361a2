#pragma once
/// How buffers of vertices and instances are told to OpenGL.

#include <epoxy/gl.h>

#include <cstddef>

namespace acentric::ui {

/// A place within the bound buffer, as OpenGL takes it: as a pointer.
inline const void* offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

/// Attribute `place`: `count` floats, `at` bytes into each vertex of `stride` bytes.
inline void floats(unsigned place, int count, std::size_t stride, std::size_t at) {
  glVertexAttribPointer(place, count, GL_FLOAT, GL_FALSE, GLsizei(stride), offset(at));
}

}  // namespace acentric::ui
