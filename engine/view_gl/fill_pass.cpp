#include "engine/view_gl/fill_pass.h"

#include <algorithm>

#include "engine/view_gl/gl_check.h"
#include "engine/view_gl/whole_picture.h"

namespace acentric {
FillPass::FillPass(ProgramCache& programs) : programs_(programs), noAttributes_(GlVertexArray::make()) {}

Status FillPass::resize(int width, int height) {
  if (width == width_ && height == height_) return {};
  levels_.clear();
  width_ = height_ = 0;
  for (int w = width, h = height; w > 1 || h > 1 || levels_.empty();) {
    w = (w + 1) / 2;
    h = (h + 1) / 2;
    Level level;
    for (PassTexture* texture : {&level.reduced, &level.expanded})
      if (Status sized = texture->resize(w, h); !sized) return sized;
    levels_.push_back(std::move(level));
  }
  width_ = width;
  height_ = height;
  return {};
}

bool FillPass::anyHole(const FrameTarget& target, GlProgram& counter) const {
  target.bindForDrawing();
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_EQUAL, 0, 0xff);
  glStencilMask(0);
  const GlQuery query = GlQuery::make();
  glBeginQuery(GL_ANY_SAMPLES_PASSED, query.name());
  drawWholePicture(counter, noAttributes_, {});
  glEndQuery(GL_ANY_SAMPLES_PASSED);
  GLuint any = 0;
  glGetQueryObjectuiv(query.name(), GL_QUERY_RESULT, &any);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glStencilMask(0xff);
  return any != 0;
}

Status FillPass::draw(const FrameTarget& target, int reach) {
  const Result<GlProgram*> counter = programs_.get("whole_picture.vert", "nothing.frag", {});
  if (!counter) return tl::unexpected(counter.error());
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_FRAMEBUFFER_SRGB);
  glDisable(GL_CULL_FACE);
  if (!anyHole(target, **counter)) return {};

  const Result<GlProgram*> first = programs_.get("whole_picture.vert", "fill_reduce.frag", {"FROM_FRAME"});
  if (!first) return tl::unexpected(first.error());
  const Result<GlProgram*> reduce = programs_.get("whole_picture.vert", "fill_reduce.frag", {});
  if (!reduce) return tl::unexpected(reduce.error());
  const Result<GlProgram*> expand = programs_.get("whole_picture.vert", "fill_expand.frag", {});
  if (!expand) return tl::unexpected(expand.error());
  const Result<GlProgram*> apply = programs_.get("whole_picture.vert", "fill_apply.frag", {});
  if (!apply) return tl::unexpected(apply.error());
  if (Status sized = resize(target.width(), target.height()); !sized) return sized;

  glDisable(GL_STENCIL_TEST);
  std::size_t used = 1;  // level n knows what is within about 2^(n+1) pixels
  while (used < levels_.size() && (2 << used) <= reach) ++used;
  for (std::size_t n = 0; n < used; ++n) {
    const Level& level = levels_[n];
    level.reduced.bindForDrawing();
    if (n == 0)
      drawWholePicture(**first, noAttributes_,
                       {{"frameColour", target.colourCodes()}, {"frameDepth", target.depths()}});
    else
      drawWholePicture(**reduce, noAttributes_, {{"finer", levels_[n - 1].reduced.name()}});
  }
  GLuint known = levels_[used - 1].reduced.name();
  for (std::size_t n = used - 1; n-- > 0;) {
    const Level& level = levels_[n];
    level.expanded.bindForDrawing();
    drawWholePicture(**expand, noAttributes_, {{"own", level.reduced.name()}, {"coarser", known}});
    known = level.expanded.name();
  }

  target.bindForDrawing();
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_EQUAL, 0, 0xff);
  glStencilOp(GL_KEEP, GL_KEEP, GL_INCR);  // covered from now on
  (*apply)->use();
  glUniform1ui((*apply)->location("invented"), kSourceInvented);
  drawWholePicture(**apply, noAttributes_, {{"coarser", known}});
  glDisable(GL_STENCIL_TEST);
  return checkGl("filling holes");
}

}  // namespace acentric
