#include "engine/view_gl/background_pass.h"

#include <glm/gtc/type_ptr.hpp>

#include "engine/view/frame.h"
#include "engine/view_gl/gl_check.h"
#include "engine/view_gl/whole_picture.h"

namespace acentric {

BackgroundPass::BackgroundPass(ProgramCache& programs)
    : programs_(programs), noAttributes_(GlVertexArray::make()) {}

Status BackgroundPass::draw(const WalkScene& scene, const PerspectiveView& view, const FrameTarget& target) {
  const BackgroundLimits limits = backgroundLimits(scene, view.eye);
  if (!showsBackground(limits, view)) return {};
  const Result<GlProgram*> found = programs_.get("whole_picture.vert", "background.frag", {});
  if (!found) return tl::unexpected(found.error());
  GlProgram& program = **found;
  program.use();
  const double focal = view.focalPixels();
  const glm::dmat3 viewFromPicture(glm::dvec3(1 / focal, 0, 0), glm::dvec3(0, 1 / focal, 0),
                                   glm::dvec3(-0.5 * view.width / focal, -0.5 * view.height / focal, 1));
  const glm::mat3 worldFromPicture(glm::transpose(view.viewFromWorld()) * viewFromPicture);
  glUniformMatrix3fv(program.location("worldFromPicture"), 1, GL_FALSE, glm::value_ptr(worldFromPicture));
  glUniform1f(program.location("pictureHeight"), float(view.height));
  glUniform1f(program.location("above"), limits.above);
  glUniform1f(program.location("below"), limits.below);
  const Sky sky = scene.plan.on(Effect::sky) ? scene.scene->sky : Sky{};
  glUniform3fv(program.location("zenith"), 1, glm::value_ptr(sky.zenith));
  glUniform3fv(program.location("horizon"), 1, glm::value_ptr(sky.horizon));
  glUniform3fv(program.location("ground"), 1, glm::value_ptr(sky.ground));
  glUniform1f(program.location("exposure"), scene.exposure);
  glUniform1ui(program.location("sourceOfBackground"), kSourceBackground);

  target.beginPainting(true);
  drawWholePicture(program, noAttributes_, {});
  target.endPainting();
  return checkGl("drawing the background");
}

}  // namespace acentric
