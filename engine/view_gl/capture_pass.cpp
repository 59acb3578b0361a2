#include "engine/view_gl/capture_pass.h"

#include <algorithm>

namespace acentric {

CapturePass::CapturePass(ProgramCache& programs, CaptureResidency& captures)
    : points_(programs, captures), cracks_(programs) {}

Status CapturePass::draw(const WalkScene& scene, const ViewPlan& plan, const PerspectiveView& view,
                         const ViewSettings& settings, FrameTarget& target, FrameStats& stats) {
  const auto sharedOf = [&](const PieceDraw& piece) { return scene.captures[std::size_t(piece.camera)]; };
  const bool anyClear = std::any_of(plan.pieces.begin(), plan.pieces.end(), [&](const PieceDraw& piece) {
    return sharedOf(piece) && sharedOf(piece)->blended;
  });
  const bool anyMirror = !plan.reflections.empty();
  if (Status ready = target.beginPieces(anyMirror); !ready) return ready;
  const bool depthTest = depthTested(settings.renderer);
  struct Step {
    const PieceDraw& piece;
    Samples samples;
  };
  std::vector<Step> steps;
  for (const bool behind : {false, true}) {
    const auto add = [&](Samples samples) {
      for (const PieceDraw& piece : plan.pieces)
        if (piece.secondary == behind &&
            (samples != Samples::clear || (sharedOf(piece) && sharedOf(piece)->blended)))
          steps.push_back({piece, samples});
    };
    add(depthTest ? Samples::opaque : Samples::all);
    if (depthTest) add(Samples::clear);  // in front of the nearest of what is opaque, as in view/warp.cpp
  }
  const bool both = std::ranges::any_of(plan.pieces, &PieceDraw::secondary);
  GLuint leastDepths = 0;  // once the first cover is drawn
  for (const auto& [planned, samples] : steps) {
    if (planned.secondary && leastDepths == 0) {
      if (Status opened = cracks_.draw(target); !opened) return opened;
      leastDepths = cracks_.leastDepths();
    }
    const std::shared_ptr<const DisplayCapture> capture = sharedOf(planned);
    if (!capture || capture->samples.empty() || planned.runs.empty()) continue;
    // Back to front by submission; depth is kept for what comes after: cracks, clear samples and the filling
    // of holes.
    target.beginPainting(depthTest                                ? FrameTarget::Depth::test
                         : anyClear || both || settings.fillHoles ? FrameTarget::Depth::keep
                                                                  : FrameTarget::Depth::ignore,
                         planned.secondary ? FrameTarget::Cover::behind : FrameTarget::Cover::inFront);
    target.bindForPieces();
    const CapturePiece piece{planned,    capture, view, settings, anyMirror ? Mirrors::mark : Mirrors::none,
                             leastDepths};
    if (Status drawn = points_.draw(piece, samples, target, stats); !drawn) return drawn;
  }
  stats.images = imagesOf(plan);
  target.endPainting();
  return {};
}

Status CapturePass::drawReflections(const WalkScene& scene, const ViewPlan& plan, const PerspectiveView& view,
                                    const ViewSettings& settings, bool localMirrors, FrameTarget& target,
                                    FrameStats& stats) {
  glDisable(GL_FRAMEBUFFER_SRGB);
  glDisable(GL_BLEND);
  target.bindForReflections();  // without the depth test, which leaves the pixels the mirror's depth
  glActiveTexture(GL_TEXTURE0);
  glBindSampler(0, 0);
  glBindTexture(GL_TEXTURE_2D, target.mirrors());
  if (localMirrors) {
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_ALWAYS, kReflection, 0xff);
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    glStencilMask(kReflection);
  }
  for (const PieceDraw& planned : plan.reflections) {
    const CapturePiece piece{planned, scene.captures[std::size_t(planned.camera)]->reflections, view,
                             settings, Mirrors::reflect};
    if (Status drawn = points_.draw(piece, Samples::all, target, stats); !drawn) return drawn;
  }
  glStencilMask(0xff);
  glDisable(GL_STENCIL_TEST);
  return {};
}

}  // namespace acentric
