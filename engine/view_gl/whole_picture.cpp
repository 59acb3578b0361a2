#include "engine/view_gl/whole_picture.h"

namespace acentric {

void drawWholePicture(GlProgram& program, const GlVertexArray& noAttributes,
                      std::initializer_list<TextureInput> inputs) {
  program.use();
  GLint unit = 0;
  for (const TextureInput& input : inputs) {
    glActiveTexture(GL_TEXTURE0 + GLenum(unit));
    glBindTexture(GL_TEXTURE_2D, input.texture);
    glBindSampler(GLuint(unit), 0);
    glUniform1i(program.location(input.uniform), unit);
    ++unit;
  }
  glBindVertexArray(noAttributes.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace acentric
