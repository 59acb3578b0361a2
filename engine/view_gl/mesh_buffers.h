#pragma once
/// Meshes of captures as OpenGL buffers, built when first drawn. A mesh larger than the driver's storage
/// buffer limit is cut between patches.

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "engine/base/result.h"
#include "engine/view/capture_mesh.h"
#include "engine/view/frame.h"
#include "engine/view/view_settings.h"
#include "engine/view_gl/gl_object.h"
#include "engine/view_gl/residency.h"

namespace acentric {

/// The patches that hold samples of some roles, in order.
struct PatchList {
  GlBuffer numbers;                        ///< of patches of the chunk, 4 bytes each
  std::vector<std::uint32_t> columnStart;  ///< columns + 1: the first whose first column is not lower
};

struct MeshChunk {
  std::vector<MeshPatch> patches;           ///< first samples count from the chunk's texels
  GlBuffer patchBuffer;                     ///< the same
  GlBuffer texels;                          ///< 8 bytes a sample: inverse distance | roles, colour | fringes
  GlBuffer mirrors;                         ///< a byte each; none without mirrors
  std::map<std::uint8_t, PatchList> lists;  ///< by roles
};

struct MeshBuffers {
  std::weak_ptr<const DisplayCapture> owner;
  std::vector<MeshChunk> chunks;
  GlBuffer borders;  ///< two floats a column border (direction), one a row border (tangent)
  MeshBound bound;
  double errorSet = 0;  ///< ViewSettings that it was built for
  int trianglesSet = 0;
  int widestPatch = 0;  ///< columns
  MeshCost cost;
  std::size_t bytes = 0;
  std::uint64_t lastUse = 0;
};

/// The chunk's patches that `roles` need, made when first asked for.
const PatchList& patchesFor(std::uint8_t roles, int columns, MeshChunk& chunk, MeshBuffers& buffers);

class MeshResidency : public Residency<MeshBuffers> {
 public:
  /// Meshes are built with `runner`.
  explicit MeshResidency(TaskRunner& runner, std::size_t largestBuffer = 0)
      : runner_(runner), largestBuffer_(largestBuffer) {}
  /// The mesh of a camera's capture for the error and the triangles that are set, built now if there is none
  /// or it was built for others. Valid until the next call of dropGone or trim.
  Result<MeshBuffers*> get(const std::shared_ptr<const DisplayCapture>& capture, const char* name,
                           const Layout& layout, int camera, const ViewSettings& settings);

 private:
  TaskRunner& runner_;
  std::size_t largestBuffer_ = 0;
};

}  // namespace acentric
