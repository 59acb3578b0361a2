#pragma once
/// How the judges of sampling see the scene: only surfaces that hide what is behind them. Glass and blended
/// surfaces let the ray pass, as they do in a bake. Injected, since inspect does not trace; engine/pipeline
/// wires it to the ray scene, tests to worlds worked out by hand.

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

namespace acentric {

struct OpaqueHit {
  double distance = std::numeric_limits<double>::infinity();  ///< metres along the ray; infinity = none
  glm::dvec3 normal{0, 0, 1};                                 ///< unit, either side
  bool found() const { return distance < std::numeric_limits<double>::infinity(); }
};

class OpaqueTracer {
 public:
  virtual ~OpaqueTracer() = default;
  /// The first opaque surface between two distances (metres) along a ray of unit direction. Safe from several
  /// threads.
  virtual OpaqueHit trace(const glm::dvec3& origin, const glm::dvec3& direction, double nearest,
                          double farthest) const = 0;
};

/// Is anything opaque between the points? A surface on the second point itself, give or take its rounding, is
/// not in between.
bool hidden(const OpaqueTracer& tracer, const glm::dvec3& from, const glm::dvec3& to);

}  // namespace acentric
