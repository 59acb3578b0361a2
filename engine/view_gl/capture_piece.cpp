#include "engine/view_gl/capture_piece.h"

#include <fmt/format.h>

#include "engine/geometry/conventions.h"

namespace acentric {

std::string captureName(int camera, Mirrors mirrors) {
  return fmt::format("{} of camera {}", mirrors == Mirrors::reflect ? "reflections" : "capture", camera);
}

glm::dmat3 pictureMatrix(const PerspectiveView& view) {
  const double focal = view.focalPixels();
  const glm::dmat3 pictureFromView(glm::dvec3(focal, 0, 0), glm::dvec3(0, focal, 0),
                                   glm::dvec3(0.5 * view.width, 0.5 * view.height, 1));
  return pictureFromView * view.viewFromWorld();
}

void setUniform(GlProgram& program, const char* name, const glm::vec2& value) {
  glUniform2f(program.location(name), value.x, value.y);
}

void setUniform(GlProgram& program, const char* name, const glm::vec3& value) {
  glUniform3f(program.location(name), value.x, value.y, value.z);
}

void setCracks(GlProgram& program, GLuint leastDepths) {
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, leastDepths);
  glBindSampler(0, 0);
  glUniform1i(program.location("leastDepths"), 0);
}

void setPart(GlProgram& program, const PieceDraw& piece) {
  const AzimuthRange& part = piece.part.azimuths;
  setUniform(program, "partLow", glm::vec2(directionOf(part.low)));
  setUniform(program, "partHigh", glm::vec2(directionOf(part.low + part.width)));
  glUniform1i(program.location("partIsWide"), part.width > kPi ? 1 : 0);
}

}  // namespace acentric
