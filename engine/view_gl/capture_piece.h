#pragma once
/// A piece of a view plan on its way to the picture: what all passes that draw samples share.

#include <memory>
#include <string>

#include "engine/geometry/perspective_view.h"
#include "engine/view/view_plan.h"
#include "engine/view_gl/gl_program.h"

namespace acentric {

enum class Samples { opaque, clear, all };

/// Pieces mark the pixels that show a mirror; what mirrors show is drawn onto those.
enum class Mirrors { none, mark, reflect };

/// For messages: of a camera's capture, or of what its mirrors show.
std::string captureName(int camera, Mirrors mirrors);

struct CapturePiece {
  const PieceDraw& plan;
  std::shared_ptr<const DisplayCapture> capture;  ///< or what its mirrors show
  const PerspectiveView& view;
  const ViewSettings& settings;
  Mirrors mirrors = Mirrors::none;
  GLuint leastDepths = 0;  ///< of the second cover: CrackPass::leastDepths

  std::string name() const { return captureName(plan.camera, mirrors); }
};

/// K M: world directions to (u z, v z, z).
glm::dmat3 pictureMatrix(const PerspectiveView& view);

void setUniform(GlProgram& program, const char* name, const glm::vec2& value);
void setUniform(GlProgram& program, const char* name, const glm::vec3& value);
/// That of shaders/cracks.glsl, at unit 0; for a program with IN_CRACKS that is in use.
void setCracks(GlProgram& program, GLuint leastDepths);
/// Those of shaders/part.glsl.
void setPart(GlProgram& program, const PieceDraw& piece);

}  // namespace acentric
