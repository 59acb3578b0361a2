#include "engine/view_gl/patch_pass.h"

#include <array>

#include "engine/view/display_patches.h"
#include "engine/view_gl/gl_check.h"
#include "engine/view_gl/whole_picture.h"

namespace acentric {
namespace {

glm::vec4 placeOf(const float* direction, float inverseDepth) {
  return {direction[0], direction[1], direction[2], inverseDepth};
}

GlPatch packed(const PatchColumn& column, const DisplayPatches& patches) {
  const auto* texels = reinterpret_cast<const std::uint32_t*>(patches.colour.data());
  return {placeOf(column.start, column.depthStart),
          placeOf(column.step, column.depthStep),
          placeOf(column.across, column.depthAcross),
          {column.columnOffset, column.rowOffset, column.middleTangent, 0},
          {GLuint(column.colour - texels), GLuint(column.columns) | GLuint(column.rows) << 16, column.mirror,
           column.blended ? 1u : 0u}};
}

/// Anew each time: what is being drawn from keeps its memory.
template <class Value>
void send(const GlBuffer& buffer, const std::vector<Value>& values, GLuint binding) {
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffer.name());
  glBufferData(GL_SHADER_STORAGE_BUFFER, GLsizeiptr(values.size() * sizeof(Value)), values.data(),
               GL_STREAM_DRAW);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.name());
}

}  // namespace

PatchPass::PatchPass(ProgramCache& programs, CaptureResidency& captures, TaskRunner& runner)
    : programs_(programs),
      captures_(captures),
      runner_(runner),
      cracks_(programs),
      noAttributes_(GlVertexArray::make()),
      patchBuffer_(GlBuffer::make()),
      listBuffer_(GlBuffer::make()),
      tileBuffer_(GlBuffer::make()),
      colours_(GL_RGBA8),
      sources_(GL_R16UI) {}

Status PatchPass::draw(const WalkScene& scene, const ViewPlan& plan, const PerspectiveView& view,
                       bool localMirrors, FrameTarget& target, FrameStats& stats) {
  if (Status sized = resize(target.width(), target.height()); !sized) return sized;
  const PatchPlan patches = planPatches(scene, view, plan, runner_);
  stats.images = imagesOf(plan);

  const bool mirrors = !plan.reflections.empty();
  glDisable(GL_BLEND);
  glDisable(GL_FRAMEBUFFER_SRGB);
  if (Status begun = begin(Show::surfaces, localMirrors, target); !begun) return begun;
  if (Status painted = paint(patches.surfaces, mirrors, false, stats); !painted) return painted;
  if (Status settled = settle(Show::surfaces, localMirrors, target); !settled) return settled;
  if (!patches.behind.empty()) {
    if (Status opened = cracks_.draw(target); !opened) return opened;
    if (Status begun = begin(Show::behind, localMirrors, target); !begun) return begun;
    if (Status painted = paint(patches.behind, mirrors, false, stats); !painted) return painted;
    if (Status settled = settle(Show::behind, localMirrors, target); !settled) return settled;
  }
  if (mirrors) {
    if (Status painted = paint(patches.reflections, mirrors, true, stats); !painted) return painted;
    if (Status painted = paint(patches.mirrors, mirrors, true, stats); !painted) return painted;
    if (Status settled = settle(Show::mirrors, localMirrors, target); !settled) return settled;
  }
  stats.samplesDrawn = stats.samplesRead;  // how many pixels they painted only the graphics card knows
  return checkGl("drawing patches");
}

Status PatchPass::resize(int width, int height) {
  if (width == width_ && height == height_) return {};
  width_ = height_ = 0;
  for (Pixels* pixels : {&now_, &before_}) {
    pixels->sums = pictureTexture(GL_RGBA32F, width, height);
    pixels->states = pictureTexture(GL_RGBA32UI, width, height);
    pixels->into = GlFramebuffer::make();
    glBindFramebuffer(GL_FRAMEBUFFER, pixels->into.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, pixels->sums.name(), 0);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, pixels->states.name(), 0);
    constexpr std::array<GLenum, 2> kTargets = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glDrawBuffers(GLsizei(kTargets.size()), kTargets.data());
  }
  noAttachments_ = GlFramebuffer::make();
  glBindFramebuffer(GL_FRAMEBUFFER, noAttachments_.name());
  glFramebufferParameteri(GL_FRAMEBUFFER, GL_FRAMEBUFFER_DEFAULT_WIDTH, width);
  glFramebufferParameteri(GL_FRAMEBUFFER, GL_FRAMEBUFFER_DEFAULT_HEIGHT, height);
  if (Status sized = colours_.resize(width, height); !sized) return sized;
  if (Status sized = sources_.resize(width, height); !sized) return sized;
  if (Status made = checkGl("making what patches are painted on"); !made) return made;
  width_ = width, height_ = height;
  return {};
}

Status PatchPass::begin(Show show, bool localMirrors, const FrameTarget& target) {
  const bool behind = show == Show::behind;
  const Result<GlProgram*> program = programs_.get("whole_picture.vert", "patches_begin.frag",
                                                   behind         ? Defines{"BEHIND"}
                                                   : localMirrors ? Defines{"LOCAL_MIRRORS"}
                                                                  : Defines{});
  if (!program) return tl::unexpected(program.error());
  if (behind) std::swap(now_, before_);
  glBindFramebuffer(GL_FRAMEBUFFER, now_.into.name());
  glViewport(0, 0, width_, height_);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_STENCIL_TEST);
  if (behind)
    drawWholePicture(**program, noAttributes_,
                     {{"sumsBefore", before_.sums.name()},
                      {"statesBefore", before_.states.name()},
                      {"leastDepths", cracks_.leastDepths()}});
  else if (localMirrors)
    drawWholePicture(**program, noAttributes_, {{"mirrors", target.mirrors()}});
  else
    drawWholePicture(**program, noAttributes_, {});
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  return checkGl("beginning to paint patches");
}

Status PatchPass::paint(const std::vector<StripDraw>& strips, bool mirrors, bool reflect, FrameStats& stats) {
  for (std::size_t first = 0, end = 0; first < strips.size(); first = end) {
    while (end < strips.size() && strips[end].piece == strips[first].piece) ++end;
    if (Status painted = paintPiece(std::span(strips).subspan(first, end - first), mirrors, reflect, stats);
        !painted)
      return painted;
  }
  return {};
}

Status PatchPass::paintPiece(std::span<const StripDraw> strips, bool mirrors, bool reflect,
                             FrameStats& stats) {
  const StripDraw& one = strips.front();
  const PatchColumn* any = nullptr;  // what is the same for all of them
  patches_.clear();
  for (const StripDraw& strip : strips)
    for (const PatchDraw& draw : strip.patches) {
      any = &draw.column;
      patches_.push_back(packed(draw.column, *one.capture->patches));
    }
  if (any == nullptr) return {};
  tiles_.find(strips, width_, height_);
  if (tiles_.tiles.empty()) return {};
  stats.samplesRead += patches_.size();

  const PieceDraw& piece = *one.piece;
  const Result<const CaptureBuffers*> buffers =
      captures_.get(one.capture, captureName(piece.camera, reflect ? Mirrors::reflect : Mirrors::none),
                    CaptureParts::patches);
  if (!buffers) return tl::unexpected(buffers.error());
  Defines defines;
  if (one.limited) defines.push_back("CLIP_TO_PART");
  if (one.capture->blended) defines.push_back("BLENDED");
  if (reflect)
    defines.push_back("REFLECT");
  else if (mirrors)
    defines.push_back("MIRRORS");
  const Result<GlProgram*> found = programs_.get("patch_tile.vert", "patches.frag", defines);
  if (!found) return tl::unexpected(found.error());
  GlProgram& program = **found;
  program.use();
  const PatchColumn& column = *any;
  setUniform(program, "pictureSize", glm::vec2(width_, height_));
  glUniform1f(program.location("side"), float(PatchTiles::kSide));
  glUniform1f(program.location("pictureHeight"), float(height_));
  setUniform(program, "perRadian", glm::vec2(column.columnsPerRadian, column.rowsPerRadian));
  glUniform1ui(program.location("roles"), column.wantedRoles);
  glUniform1ui(program.location("sourceOfPiece"), GLuint(sourceOfCamera(piece.camera)));
  if (one.limited) {
    setUniform(program, "low", glm::vec3(one.lowStart, one.lowAcross, column.lowStep));
    setUniform(program, "high", glm::vec3(one.highStart, one.highAcross, column.highStep));
    glUniform1i(program.location("partIsWide"), column.eitherSide ? 1 : 0);
  }
  send(patchBuffer_, patches_, 0);
  send(listBuffer_, tiles_.patches, 1);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, (*buffers)->patchColours.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, (*buffers)->patchCovers.name());
  send(tileBuffer_, tiles_.tiles, 5);
  glBindImageTexture(0, now_.sums.name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
  glBindImageTexture(1, now_.states.name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32UI);
  glBindFramebuffer(GL_FRAMEBUFFER, noAttachments_.name());
  glViewport(0, 0, width_, height_);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_STENCIL_TEST);
  glBindVertexArray(noAttributes_.name());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(tiles_.tiles.size()));
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
  return checkGl("painting patches");
}

Status PatchPass::settle(Show show, bool localMirrors, const FrameTarget& target) {
  Defines defines;
  if (show == Show::mirrors) defines.push_back("MIRRORS");
  if (show == Show::behind) defines.push_back("IN_CRACKS");
  const Result<GlProgram*> found = programs_.get("whole_picture.vert", "patches_settle.frag", defines);
  if (!found) return tl::unexpected(found.error());
  const auto copy = [&](GLuint from, GLuint to) {
    glCopyImageSubData(from, GL_TEXTURE_2D, 0, 0, 0, 0, to, GL_TEXTURE_2D, 0, 0, 0, 0, width_, height_, 1);
  };
  copy(target.colourCodes(), colours_.name());
  copy(target.sources(), sources_.name());
  const auto draw = [&](bool local) {
    (*found)->use();
    glUniform1ui((*found)->location("hole"), kSourceHole);
    glUniform1ui((*found)->location("background"), kSourceBackground);
    glUniform1i((*found)->location("local"), local ? 1 : 0);
    const TextureInput sums{"sums", now_.sums.name()}, states{"states", now_.states.name()},
        colours{"coloursBefore", colours_.name()}, sources{"sourcesBefore", sources_.name()};
    if (show == Show::behind)
      drawWholePicture(**found, noAttributes_,
                       {sums, states, colours, sources, {"leastDepths", cracks_.leastDepths()}});
    else
      drawWholePicture(**found, noAttributes_, {sums, states, colours, sources});
  };
  target.bindForDrawing();
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GEQUAL);  // what local geometry hides does not matter
  glEnable(GL_STENCIL_TEST);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  glStencilFunc(GL_ALWAYS, show == Show::behind ? kCovered : kCovered | kInFront, 0xff);
  draw(false);
  if (show == Show::mirrors && localMirrors) {  // which keep their own depth
    glDisable(GL_DEPTH_TEST);
    glStencilFunc(GL_ALWAYS, kReflection, 0xff);
    glStencilMask(kReflection);
    draw(true);
    glStencilMask(0xff);
  }
  glDepthFunc(GL_GREATER);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_STENCIL_TEST);
  return checkGl("settling what patches show");
}

}  // namespace acentric
