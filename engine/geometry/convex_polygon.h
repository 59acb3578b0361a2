#pragma once
/// Convex polygons in plan, counter-clockwise, metres.

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace acentric {

struct ConvexPolygon {
  std::vector<glm::dvec2> corners;  ///< counter-clockwise, at least 3, no repeats

  std::size_t size() const { return corners.size(); }
  double area() const;
  glm::dvec2 centroid() const;
  /// Half-open: of two polygons that share an edge exactly one holds a point on it (exact predicate; an edge
  /// belongs to the polygon that lies on its left when the edge is directed by a rule of its end points).
  bool contains(const glm::dvec2& point) const;
  /// Inside or on the border (exact predicate).
  bool containsClosed(const glm::dvec2& point) const;
  /// Each edge moved outwards by `distance` metres, corners mitred. Inwards if negative (may become empty).
  ConvexPolygon grown(double distance) const;
  /// Distances [enter, leave] along origin + t*direction (unit), t >= 0, inside the polygon; nothing if
  /// missed.
  std::optional<std::pair<double, double>> raySpan(const glm::dvec2& origin,
                                                   const glm::dvec2& direction) const;
  /// Nearest point of the closed polygon.
  glm::dvec2 nearestPoint(const glm::dvec2& point) const;
};

/// ConvexPolygon::contains for corners kept elsewhere.
bool containsHalfOpen(std::span<const glm::dvec2> corners, const glm::dvec2& point);

/// Do the closed polygons share a point?
bool overlap(const ConvexPolygon& a, const ConvexPolygon& b);

}  // namespace acentric
