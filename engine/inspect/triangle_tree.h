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

  /// As many as clipToPolygon(scene, polygon).triangles.
  std::size_t countClipped(const ConvexPolygon& polygon) const;

 private:
  struct Triangle {
    std::uint32_t mesh, index;
  };
  struct Node {
    glm::vec2 min{std::numeric_limits<float>::max()}, max{std::numeric_limits<float>::lowest()};
    std::uint32_t withArea = 0;  ///< triangles below that are not degenerate
  };
  class Query;
  std::array<glm::vec3, 3> cornersOf(const Triangle& triangle) const;
  void sortTriangles();
  void makeNodes();

  ScenePtr scene_;
  std::vector<Triangle> triangles_;  ///< neighbours in the plan and alike in size are neighbours here
  std::size_t leaves_ = 0;           ///< a power of two; leaf k holds triangles [k, k + 1) * kLeafTriangles
  std::vector<Node> nodes_;          ///< children of n: 2n and 2n + 1; the root is 1, leaf k is leaves_ + k
};

}  // namespace acentric
