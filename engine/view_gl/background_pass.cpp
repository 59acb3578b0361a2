#include "engine/view_gl/background_pass.h"

#include <glm/gtc/type_ptr.hpp>

#include "engine/geometry/conventions.h"
#include "engine/view/frame.h"
#include "engine/view_gl/gl_check.h"
#include "engine/view_gl/whole_picture.h"

namespace acentric {

BackgroundPass::BackgroundPass(ProgramCache& programs, CaptureResidency& captures)
    : programs_(programs),
      captures_(captures),
      noAttributes_(GlVertexArray::make()),
      columnRuns_(GlBuffer::make()) {}

Result<GlProgram*> BackgroundPass::program(const Defines& defines, const PerspectiveView& view,
                                           const Sky& sky, float exposure, PixelSource source) {
  const Result<GlProgram*> found = programs_.get("whole_picture.vert", "background.frag", defines);
  if (!found) return found;
  GlProgram& program = **found;
  program.use();
  const double focal = view.focalPixels();
  const glm::dmat3 viewFromPicture(glm::dvec3(1 / focal, 0, 0), glm::dvec3(0, 1 / focal, 0),
                                   glm::dvec3(-0.5 * view.width / focal, -0.5 * view.height / focal, 1));
  const glm::mat3 worldFromPicture(glm::transpose(view.viewFromWorld()) * viewFromPicture);
  glUniformMatrix3fv(program.location("worldFromPicture"), 1, GL_FALSE, glm::value_ptr(worldFromPicture));
  glUniform1f(program.location("pictureHeight"), float(view.height));
  glUniform3fv(program.location("zenith"), 1, glm::value_ptr(sky.zenith));
  glUniform3fv(program.location("horizon"), 1, glm::value_ptr(sky.horizon));
  glUniform3fv(program.location("ground"), 1, glm::value_ptr(sky.ground));
  glUniform1f(program.location("exposure"), exposure);
  glUniform1ui(program.location("sourceOfBackground"), source);
  return found;
}

Status BackgroundPass::draw(const WalkScene& scene, const ViewPlan& plan, const PerspectiveView& view,
                            const FrameTarget& target) {
  const BackgroundLimits limits = backgroundLimits(scene, view.eye);
  const bool beyondRows = showsBackground(limits, view);
  if (!beyondRows && plan.backgrounds.empty()) return {};
  target.bindForDrawing();
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_ALWAYS);
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_ALWAYS, kCovered, 0xff);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  glDisable(GL_FRAMEBUFFER_SRGB);
  glDisable(GL_BLEND);
  if (beyondRows) {
    const Sky sky = scene.plan.on(Effect::sky) ? scene.scene->sky : Sky{};
    const Result<GlProgram*> found = program({}, view, sky, scene.exposure, kSourceBackground);
    if (!found) return tl::unexpected(found.error());
    glUniform1f((*found)->location("above"), limits.above);
    glUniform1f((*found)->location("below"), limits.below);
    drawWholePicture(**found, noAttributes_, {});
  }
  for (const PieceDraw& piece : plan.backgrounds)
    if (Status drawn = drawCaptured(scene, piece, view); !drawn) return drawn;
  glDepthFunc(GL_GREATER);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_STENCIL_TEST);
  return checkGl("drawing the background");
}

Status BackgroundPass::drawCaptured(const WalkScene& scene, const PieceDraw& piece,
                                    const PerspectiveView& view) {
  const std::shared_ptr<const DisplayCapture>& capture = scene.captures[std::size_t(piece.camera)];
  const Result<const CaptureBuffers*> buffers = captures_.get(capture, captureName(piece.camera, false));
  if (!buffers) return tl::unexpected(buffers.error());
  const ColumnCamera& camera = capture->camera;
  const CaptureBackground& background = capture->background.runs;
  runs_.assign(std::size_t(camera.columns), glm::uvec2(0));
  for (const ColumnRun& run : piece.runs)
    for (std::size_t k = std::size_t(run.first); k < std::size_t(run.last); ++k)
      runs_[k] = {background.columnStart[k], background.columnStart[k + 1]};
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, columnRuns_.name());
  glBufferData(GL_SHADER_STORAGE_BUFFER, GLsizeiptr(runs_.size() * sizeof runs_[0]), runs_.data(),
               GL_STREAM_DRAW);

  Defines defines{"CAPTURED"};
  if (piece.clipToPart) defines.push_back("CLIP_TO_PART");
  const Result<GlProgram*> found =
      program(defines, view, background.sky, scene.exposure, sourceOfCamera(piece.camera));
  if (!found) return tl::unexpected(found.error());
  GlProgram& program = **found;
  const auto setDirection = [&](const char* uniform, double azimuth) {
    const glm::vec2 direction(directionOf(azimuth));
    glUniform2f(program.location(uniform), direction.x, direction.y);
  };
  if (piece.clipToPart) {
    const AzimuthRange& part = piece.part.azimuths;
    setDirection("partLow", part.low);
    setDirection("partHigh", part.low + part.width);
    glUniform1i(program.location("partIsWide"), part.width > kPi ? 1 : 0);
  }
  setDirection("middle", camera.lowAzimuth + 0.5 * camera.fovRadians);
  glUniform2f(program.location("columnsAndPerRadian"), float(camera.columns),
              float(camera.columns / camera.fovRadians));
  glUniform2f(program.location("topAndRowsPerRadian"), float(camera.topElevation),
              float(1 / camera.rowPitch()));
  glUniform1ui(program.location("roles"), piece.roles);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, columnRuns_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, (*buffers)->background.name());
  drawWholePicture(program, noAttributes_, {});
  return {};
}

}  // namespace acentric
