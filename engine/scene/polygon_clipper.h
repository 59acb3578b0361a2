#pragma once
/// Clips triangles in plan to a convex polygon. Which side of an edge a corner lies on is decided exactly, so
/// that two polygons that share an edge agree: what lies on it belongs to both.

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "engine/geometry/convex_polygon.h"
#include "engine/scene/scene.h"

namespace acentric {

class PolygonClipper {
 public:
  /// A corner of what is left: where it is and which blend of the triangle.
  struct Corner {
    glm::dvec3 position{0};
    glm::dvec2 barycentric{0};  ///< weights of the 2nd and 3rd corner
  };
  /// Refers to `polygon`.
  explicit PolygonClipper(const ConvexPolygon& polygon);

  /// The part of the triangle over the polygon, in the triangle's winding; fewer than three corners: nothing.
  /// Valid until the next call.
  const std::vector<Corner>& clip(const std::array<glm::vec3, 3>& triangle);
  /// Is there anything of the triangle over the polygon?
  bool leavesArea(const std::array<glm::vec3, 3>& triangle);
  /// Is all that lies in this box (an empty one too) beside the polygon, as its box tells?
  bool misses(const Bounds& box) const;
  /// Does the fan's triangle (corner 0, i - 1, i) have area?
  static bool hasArea(const std::vector<Corner>& corners, std::size_t i);

 private:
  bool missesBox(const std::array<glm::vec3, 3>& triangle) const;
  void clipToEdge(const glm::dvec2& a, const glm::dvec2& b);

  const ConvexPolygon& polygon_;
  glm::dvec2 min_, max_;
  std::vector<Corner> current_, next_;
  std::vector<double> sides_;
};

}  // namespace acentric
