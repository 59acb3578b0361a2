#pragma once
/// The nearest point that a polygon holds for certain.

#include "engine/geometry/convex_polygon.h"

namespace acentric {

/// `point` if `holds(point)`, else the nearest border point moved inwards by no more than rounding asks for.
template <class Holds>
glm::dvec2 pointInside(const ConvexPolygon& polygon, const glm::dvec2& point, const Holds& holds) {
  if (holds(point)) return point;
  const glm::dvec2 border = polygon.nearestPoint(point), centre = polygon.centroid();
  for (double step = 1e-12; step < 0.5; step *= 4)
    if (const glm::dvec2 moved = border + step * (centre - border); holds(moved)) return moved;
  return centre;
}

}  // namespace acentric
