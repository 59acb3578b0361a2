#pragma once
/// Draws a piece of a view plan as points, back to front by submission, without a depth test (list priority);
/// or with one, in any order.

#include "engine/view/frame.h"
#include "engine/view_gl/capture_piece.h"
#include "engine/view_gl/capture_residency.h"
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
  /// Into what is bound of `target`, ready for painting. Counts samples in `stats`.
  Status draw(const CapturePiece& piece, Samples samples, FrameTarget& target, FrameStats& stats);

 private:
  /// With its buffers.
  struct Piece;
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
