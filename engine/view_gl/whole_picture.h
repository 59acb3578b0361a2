#pragma once
/// Drawing one triangle over the whole picture, with textures at the first units.

#include <initializer_list>

#include "engine/view_gl/gl_object.h"
#include "engine/view_gl/gl_program.h"

namespace acentric {

struct TextureInput {
  const char* uniform;
  GLuint texture;
};

/// `program` was made with whole_picture.vert; `noAttributes` is an empty vertex array.
void drawWholePicture(GlProgram& program, const GlVertexArray& noAttributes,
                      std::initializer_list<TextureInput> inputs);

}  // namespace acentric
