#include "engine/geometry/predicates/orientation.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>

namespace acentric {

int orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  // The exact fallback converts coordinates to rationals: a NaN or an infinity would not survive that.
  if (!std::isfinite(a.x + a.y + b.x + b.y + c.x + c.y)) return 0;
  return static_cast<int>(
      CGAL::orientation(Kernel::Point_2(a.x, a.y), Kernel::Point_2(b.x, b.y), Kernel::Point_2(c.x, c.y)));
}

}  // namespace acentric
