#pragma once
/// Which of several storeys an eye is drawn from.

#include <cmath>

#include "engine/layout/layout.h"

namespace acentric {

/// How badly a storey suits an eye, metres: by height, and ten times as much by how far its nearest region is
/// on the plan. So of the pieces of stairs those that the eye is in go first, then the one at its height; and
/// an eye that rounding puts beside a floor is still on it. `away`: metres on the plan to that region.
inline double misfitOf(double away, const Layout& storey, const glm::dvec3& eye) {
  return std::hypot(10 * away, eye.z - storey.eyeZ());
}

/// Infinite where the storey has no region.
inline double misfitOf(const Layout& storey, const glm::dvec3& eye) {
  const Layout::Nearest nearest = storey.nearestRegion(glm::dvec2(eye));
  if (nearest.region < 0) return std::numeric_limits<double>::infinity();
  return misfitOf(glm::distance(nearest.point, glm::dvec2(eye)), storey, eye);
}

}  // namespace acentric
