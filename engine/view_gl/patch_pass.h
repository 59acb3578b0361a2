#pragma once
/// Draws what a view plan takes from captures as patches (engine/view/patch_plan.h), front to back: for each
/// piece the tiles of the picture that it may show in, each with the list of the patches there. A pixel goes
/// through the list until nothing of it is open. As on the processor, and no depth test decides anything.

#include <memory>

#include "engine/base/task_runner.h"
#include "engine/view/frame.h"
#include "engine/view/patch_tables.h"
#include "engine/view_gl/capture_residency.h"
#include "engine/view_gl/crack_pass.h"
#include "engine/view_gl/frame_target.h"
#include "engine/view_gl/gl_program.h"
#include "engine/view_gl/pass_texture.h"

namespace acentric {

class PatchPass {
 public:
  /// Frames are planned with `runner`.
  PatchPass(ProgramCache& programs, CaptureResidency& captures, TaskRunner& runner);
  /// Into `target`, which holds the background. `localMirrors`: it says which pixels show mirrors of local
  /// geometry (LocalPass::markMirrors). Counts images and patches in `stats`.
  Status draw(const WalkScene& scene, const ViewPlan& plan, const PerspectiveView& view, bool localMirrors,
              FrameTarget& target, FrameStats& stats);

 private:
  enum class Show { surfaces, behind, mirrors };
  Status begin(Show show, bool localMirrors, const FrameTarget& target);
  /// Strips of one piece after another.
  Status paint(const std::vector<StripDraw>& strips, bool mirrors, bool reflect, FrameStats& stats);
  Status paintPiece(std::span<const StripDraw> strips, bool mirrors, bool reflect, FrameStats& stats);
  /// From what was painted to colours.
  Status settle(Show show, bool localMirrors, const FrameTarget& target);
  Status resize(int width, int height);

  ProgramCache& programs_;
  CaptureResidency& captures_;
  TaskRunner& runner_;
  CrackPass cracks_;
  GlVertexArray noAttributes_, tileArray_;
  GlBuffer patchBuffer_, listBuffer_, tileBuffer_;
  /// Of pixels: what patches are painted on, and what it was before the second cover.
  struct Pixels {
    GlTexture sums, states;
    GlFramebuffer into;
  };
  Pixels now_, before_;
  GlFramebuffer noAttachments_;  ///< patches are stored, not drawn
  int width_ = 0, height_ = 0;
  PassTexture colours_, sources_;  ///< the picture before a settling
  PatchTables tables_;             // kept between pieces for their memory
};

}  // namespace acentric
