#pragma once
/// Which of two directions comes first, turning counter-clockwise: signs by the exact predicate, sizes by
/// atan2.

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/geometry/conventions.h"
#include "engine/geometry/predicates/orientation.h"

namespace acentric {

/// +1: b is counter-clockwise of a (by less than half a turn), -1: clockwise, 0: parallel either way.
inline int turn(const glm::dvec2& a, const glm::dvec2& b) { return orientation(glm::dvec2(0), a, b); }

/// The angle from a counter-clockwise to b in [0, 2 pi]; exactly 0 only where they point the same way.
inline double angleFrom(const glm::dvec2& a, const glm::dvec2& b) {
  // The cross product may round to zero where the exact sign does not.
  const double size =
      std::max(std::atan2(std::abs(cross(a, b)), glm::dot(a, b)), std::numeric_limits<double>::min());
  switch (turn(a, b)) {
    case 1:
      return size;
    case -1:
      return kTwoPi - size;
    default:
      return glm::dot(a, b) >= 0 ? 0.0 : kPi;
  }
}

/// Does direction v lie in [from, to), turning counter-clockwise from `from` by half a turn at most?
inline bool inArc(const glm::dvec2& from, const glm::dvec2& v, const glm::dvec2& to) {
  const int begun = turn(from, v);
  if (begun == 0) return glm::dot(from, v) > 0;
  return begun > 0 && turn(v, to) > 0;
}

}  // namespace acentric
