#include "engine/view_gl/patch_pass.h"

#include <array>
#include <bit>
#include <cstddef>

#include "engine/view/display_patches.h"
#include "engine/view_gl/gl_check.h"
#include "engine/view_gl/whole_picture.h"

namespace acentric {
namespace {

/// Anew each time: what is being drawn from keeps its memory.
template <class Value>
void send(const GlBuffer& buffer, const std::vector<Value>& values, GLenum target) {
  glBindBuffer(target, buffer.name());
  glBufferData(target, GLsizeiptr(values.size() * sizeof(Value)), values.data(), GL_STREAM_DRAW);
}
template <class Value>
void sendForShaders(const GlBuffer& buffer, const std::vector<Value>& values, GLuint binding) {
  send(buffer, values, GL_SHADER_STORAGE_BUFFER);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.name());
}

}  // namespace

PatchPass::PatchPass(ProgramCache& programs, CaptureResidency& captures, TaskRunner& runner)
    : programs_(programs),
      captures_(captures),
      runner_(runner),
      cracks_(programs),
      noAttributes_(GlVertexArray::make()),
      tileArray_(GlVertexArray::make()),
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
    if (Status found = cracks_.draw(target); !found) return found;
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
  glBindVertexArray(tileArray_.name());
  glBindBuffer(GL_ARRAY_BUFFER, tileBuffer_.name());
  const auto attribute = [](GLuint index, GLenum type, std::size_t offset) {
    glEnableVertexAttribArray(index);
    glVertexAttribIPointer(index, 2, type, sizeof(PatchTile), reinterpret_cast<const void*>(offset));
    glVertexAttribDivisor(index, 1);
  };
  attribute(0, GL_UNSIGNED_SHORT, offsetof(PatchTile, x));
  attribute(1, GL_UNSIGNED_INT, offsetof(PatchTile, first));
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
  tables_.set(strips, width_, height_, [](const DisplayCapture&) { return 0; });
  if (tables_.tiles.tiles.empty()) return {};
  stats.samplesRead += tables_.patches.size();

  const Result<const CaptureBuffers*> buffers =
      captures_.get(one.capture, captureName(one.piece->camera, reflect));
  if (!buffers) return tl::unexpected(buffers.error());
  Defines defines;
  if (reflect)
    defines.push_back("REFLECT");
  else if (mirrors)
    defines.push_back("MIRRORS");
  const Result<GlProgram*> found = programs_.get("patch_tile.vert", "patches.frag", defines);
  if (!found) return tl::unexpected(found.error());
  GlProgram& program = **found;
  program.use();
  glUniform2f(program.location("pictureSize"), float(width_), float(height_));
  glUniform1f(program.location("side"), float(PatchTiles::kSide));
  glUniform1f(program.location("pictureHeight"), float(height_));
  const auto piece = std::bit_cast<std::array<GLuint, 12>>(tables_.pieces.front());
  glUniform4uiv(program.location("pieceWords"), 3, piece.data());
  sendForShaders(patchBuffer_, tables_.patches, 0);
  sendForShaders(listBuffer_, tables_.tiles.patches, 1);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, (*buffers)->patchColours.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, (*buffers)->patchCovers.name());
  glBindImageTexture(0, now_.sums.name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
  glBindImageTexture(1, now_.states.name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32UI);
  glBindFramebuffer(GL_FRAMEBUFFER, noAttachments_.name());
  glViewport(0, 0, width_, height_);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_STENCIL_TEST);
  glBindVertexArray(tileArray_.name());
  send(tileBuffer_, tables_.tiles.tiles, GL_ARRAY_BUFFER);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(tables_.tiles.tiles.size()));
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
  return checkGl("painting patches");
}

Status PatchPass::settle(Show show, bool localMirrors, const FrameTarget& target) {
  Defines defines;
  if (show == Show::mirrors) defines.push_back("MIRRORS");
  if (show == Show::behind) defines.push_back("BEHIND");
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
                       {sums,
                        states,
                        colours,
                        sources,
                        {"statesBefore", before_.states.name()},
                        {"leastDepths", cracks_.leastDepths()}});
    else
      drawWholePicture(**found, noAttributes_, {sums, states, colours, sources});
  };
  target.bindForDrawing();
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GEQUAL);  // what local geometry hides does not matter
  glEnable(GL_STENCIL_TEST);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  glStencilFunc(GL_ALWAYS, kCovered, 0xff);
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
