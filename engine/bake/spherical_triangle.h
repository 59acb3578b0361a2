#pragma once
/// A triangle as a point sees it: the light it sends there in closed form, and directions drawn uniformly
/// from the part of the sphere that it covers.

#include <array>
#include <glm/glm.hpp>

namespace acentric {

/// Irradiance from a triangle of radiance 1 whose corners are given relative to the lit point, of unit normal
/// `normal`; what lies below its horizon does not count (Lambert's formula for polygons). Either side emits.
double triangleIrradiance(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& normal);

class SphericalTriangle {
 public:
  explicit SphericalTriangle(const std::array<glm::dvec3, 3>& corners);
  double solidAngle() const { return solidAngle_; }
  /// Unit direction for a point of the unit square, areas to areas (Arvo, "Stratified Sampling of Spherical
  /// Triangles", SIGGRAPH 1995).
  glm::dvec3 directionAt(glm::dvec2 u) const;

 private:
  glm::dvec3 a_, b_, c_;
  double angleAtA_ = 0, solidAngle_ = 0;
};

}  // namespace acentric
