#pragma once
/// Counts the triangles that clipping the scene to a convex polygon gives, without clipping most of them: a
/// tree of boxes over the plan, with the number of triangles under each. What lies wholly inside or outside
/// is settled box by box by exact predicates; only triangles at the polygon's border are clipped.
/// Immutable: one tree serves many threads.

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "engine/geometry/convex_polygon.h"
#include "engine/scene/scene.h"

namespace acentric {

class TriangleTree {
 public:
  explicit TriangleTree(ScenePtr scene);

  /// As many as clipToPolygon(flattened(scene), polygon).triangles.
  std::size_t countClipped(const ConvexPolygon& polygon) const;

 private:
  struct Triangle {
    std::uint32_t mesh, index;
  };
  struct Node {
    Bounds box;
    std::uint32_t withArea = 0;  ///< triangles below that are not degenerate
  };
  /// Over triangles of some meshes, where these are.
  struct Tree {
    Tree(const std::vector<Mesh>& meshes, std::vector<Triangle> all);
    std::vector<Triangle> triangles;  ///< neighbours in the plan and alike in size are neighbours here
    std::size_t leaves = 0;           ///< a power of two; leaf k holds triangles [k, k + 1) * kLeafTriangles
    std::vector<Node> nodes;          ///< children of n: 2n and 2n + 1; the root is 1, leaf k is leaves + k
  };
  class Query;

  ScenePtr scene_;
  Tree meshes_;
  std::vector<Tree> prototypes_;  ///< in their own frames
  std::vector<Bounds> boxes_;     ///< by instance
};

}  // namespace acentric
