#pragma once
/// A walkable outline in plan: simple polygons and the holes in them, metres.

#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/geometry/convex_polygon.h"

namespace acentric {

struct Outline {
  /// Closed loops without repeated last point. Even-odd rule: a loop within a loop is a hole.
  std::vector<std::vector<glm::dvec2>> loops;

  bool empty() const { return loops.empty(); }
  double area() const;  ///< square metres, holes taken off
  bool contains(const glm::dvec2& point) const;
  /// Does the closed convex polygon share area with the outline's inside?
  bool overlaps(const ConvexPolygon& polygon) const;
  glm::dvec2 nearestPoint(const glm::dvec2& point) const;  ///< the point itself if inside
  bool operator==(const Outline&) const = default;
};

/// "x,y;x,y;..." (metres; loops separated by '/').
Result<Outline> parseOutline(std::string_view text);
std::string formatOutline(const Outline& outline);

}  // namespace acentric
