#pragma once
/// Meshes of captures as OpenGL buffers, built when first drawn. A mesh larger than the driver's storage
/// buffer limit is cut between patches.

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "engine/view_gl/buffer_upload.h"
#include "engine/view_gl/gl_object.h"
#include "engine/view_gl/packed_mesh.h"

namespace acentric {

/// The patches that hold samples of some roles, in order.
struct PatchList {
  GlBuffer numbers;                        ///< of patches of the chunk, 4 bytes each
  std::vector<std::uint32_t> columnStart;  ///< columns + 1: the first whose first column is not lower
};

struct MeshChunk {
  std::vector<MeshPatch> patches;           ///< as PackedChunk has them
  GlBuffer patchBuffer;                     ///< the same
  GlBuffer texels;                          ///< 8 bytes a sample
  GlBuffer mirrors;                         ///< a byte each; none without mirrors
  std::map<std::uint8_t, PatchList> lists;  ///< by roles
};

struct MeshBuffers {
  std::weak_ptr<const DisplayCapture> owner;
  MeshTask task;  ///< that it was built for
  std::vector<MeshChunk> chunks;
  GlBuffer borders;  ///< as PackedMesh has them
  MeshBound bound;
  int widestPatch = 0;  ///< columns
  MeshCost cost;
  std::size_t bytes = 0;
  std::uint64_t lastUse = 0;
};

/// The chunk's patches that `roles` need, made when first asked for.
const PatchList& patchesFor(std::uint8_t roles, int columns, MeshChunk& chunk, MeshBuffers& buffers);

/// A mesh on its way to the graphics card, piece by piece.
class MeshUpload {
 public:
  MeshUpload(MeshTask task, PackedMesh mesh);
  const MeshTask& task() const { return buffers_.task; }
  /// Sends at most so many bytes more, or all that are left; returns how many.
  std::size_t send(std::size_t most) { return sending_.send(most); }
  bool done() const { return sending_.done(); }
  std::size_t bytes() const { return sending_.bytes(); }
  /// Once it is done.
  MeshBuffers take() { return std::move(buffers_); }

 private:
  MeshBuffers buffers_;
  BufferUpload sending_;
};

}  // namespace acentric
