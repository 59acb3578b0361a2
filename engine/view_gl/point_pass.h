#pragma once
/// Draws the pieces of a view plan as points, back to front by submission, without a depth test (list
/// priority); or, for comparison, the same points with one.

#include "engine/geometry/perspective_view.h"
#include "engine/view/frame.h"
#include "engine/view/view_plan.h"
#include "engine/view_gl/capture_buffers.h"
#include "engine/view_gl/frame_target.h"
#include "engine/view_gl/gl_program.h"

namespace acentric {

/// How a piece reads one column; the layout of `Column` in shaders/points.vert.
struct ColumnPlan {
  glm::vec4 inPicture;  ///< direction in picture coordinates, largest inverse distance drawn
  glm::uvec4
      parts;  ///< samples above the pivot row [x, y), below [y, z), within the chunk; w: towards the pivot
  glm::vec2 inPlan;  ///< c
  float footInverse;
  float leastInverse;  ///< of a clipped piece; else 0
};
static_assert(sizeof(ColumnPlan) == 48, "the shader reads a stride of 48 bytes");

class PointPass {
 public:
  PointPass(ProgramCache& programs, CaptureResidency& captures);
  /// Into `target`, which begin() has cleared. Writes depth only where a later pass reads it. Counts images
  /// and samples in `stats`.
  Status draw(const WalkScene& scene, const ViewPlan& plan, const PerspectiveView& view,
              const ViewSettings& settings, FrameTarget& target, FrameStats& stats);
  /// What mirrors show, onto the pixels that `target` says belong to them. `localMirrors`: some are local
  /// geometry; the stencil then says what was drawn.
  Status drawReflections(const WalkScene& scene, const ViewPlan& plan, const PerspectiveView& view,
                         const ViewSettings& settings, bool localMirrors, FrameTarget& target,
                         FrameStats& stats);

 private:
  /// One piece on its way: what all its draw calls share.
  struct Piece;
  enum class Samples { opaque, clear, all };
  Status drawPiece(Piece& piece, Samples samples, FrameTarget& target, FrameStats& stats);
  /// Blended samples behind one another in a pixel cannot be drawn at once: the splats of one pane overlap,
  /// and where they do the pane must still tint once. So rank by rank, each into a layer of its own, laid
  /// over the picture.
  Status drawClearRanks(Piece& piece, FrameTarget& target, FrameStats& stats);
  Result<GlProgram*> program(const Piece& piece, Samples samples);
  /// Columns with more than `clearRank` clear samples in a pixel; all of them for a negative rank.
  void drawColumns(const Piece& piece, int clearRank, FrameStats& stats);

  ProgramCache& programs_;
  CaptureResidency& captures_;
  GlVertexArray noAttributes_;  ///< points pull their data from buffers
  GlBuffer columnPlans_;
  std::vector<ColumnPlan> plans_;  // kept between pieces for their memory
  std::vector<GLint> firsts_;
  std::vector<GLsizei> counts_;
};

}  // namespace acentric
