#pragma once
/// Turns one mesh as read into one that can be relied on. Private to this folder.

#include "engine/scene/source_scene.h"

namespace acentric {

struct CleaningCounts {
  std::size_t kept = 0;
  std::size_t indexOutOfRange = 0;
  std::size_t notFinite = 0;
  std::size_t degenerate = 0;
  std::size_t normalsMade = 0;  ///< meshes whose normals were made flat
  std::size_t tangentsMade = 0;
};

/// Drops triangles with indices out of range or positions that are not finite numbers, before sizes are
/// measured.
void dropBroken(SourceMesh& mesh, CleaningCounts& counts);

/// Positions to float, relative to `origin` (metres, Z up); drops degenerate triangles and unused corners;
/// makes flat normals where there are none, tangents where `wantsTangents` and there are none (from uv set
/// `tangentSet`).
Mesh cleanMesh(SourceMesh&& source, const glm::dvec3& origin, bool wantsTangents, int tangentSet,
               const glm::mat3x2& uvTransform, CleaningCounts& counts);

}  // namespace acentric
