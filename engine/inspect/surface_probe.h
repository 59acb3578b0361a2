#pragma once
/// How inspect looks at a scene: one ray in, the nearest surface out. Injected, since inspect does not trace;
/// the pipeline wires it to the ray scene, tests to worlds worked out by hand. Must answer alike every time;
/// safe from several threads if the thing behind it is.

#include <functional>
#include <glm/glm.hpp>
#include <limits>

namespace acentric {

/// What a ray met first.
struct SurfaceHit {
  double distance = std::numeric_limits<double>::infinity();  ///< metres; infinity (or NaN) = nothing
  glm::dvec3 normal{0};  ///< unit, out of the front as the triangle is wound; 0 = unknown
  bool found() const { return distance >= 0 && distance < std::numeric_limits<double>::infinity(); }
  /// Did a ray in this direction meet the surface from behind? Inside a closed solid every surface shows its
  /// back.
  bool showsBack(const glm::dvec3& direction) const { return found() && glm::dot(normal, direction) > 0; }
};

/// Origin and unit direction in the world.
using SurfaceProbe = std::function<SurfaceHit(const glm::dvec3& origin, const glm::dvec3& direction)>;

}  // namespace acentric
