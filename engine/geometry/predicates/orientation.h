#pragma once
/// Exact orientation of points in the plane (CGAL's filtered kernel: exact sign, no rounding).

#include <glm/glm.hpp>

namespace acentric {

/// Sign of the area of triangle (a, b, c): +1 counter-clockwise (c left of a->b), -1 clockwise, 0 collinear.
int orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c);

}  // namespace acentric
