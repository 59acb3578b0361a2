#pragma once
/// Draws the opaque samples of a piece of a view plan as the mesh of its capture, with a depth test.

#include "engine/view/frame.h"
#include "engine/view_gl/capture_piece.h"
#include "engine/view_gl/mesh_buffers.h"

namespace acentric {

class MeshPass {
 public:
  explicit MeshPass(ProgramCache& programs);
  /// `mesh` is that of the piece's capture. Into what is bound, ready for painting with a depth test. Counts
  /// triangles in `stats`.
  Status draw(const CapturePiece& piece, MeshBuffers& mesh, FrameStats& stats);

 private:
  Result<GlProgram*> program(const CapturePiece& piece, const MeshBuffers& mesh);
  void drawChunk(const CapturePiece& piece, MeshChunk& chunk, MeshBuffers& mesh, FrameStats& stats);

  ProgramCache& programs_;
  GlVertexArray noAttributes_;  ///< triangles pull their data from buffers
  GlBuffer limits_;
};

}  // namespace acentric
