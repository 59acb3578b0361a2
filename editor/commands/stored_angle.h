#pragma once
/// Project files keep angles as degrees with nine decimals: what an edit sets is what is read back.

#include <cmath>

#include "engine/geometry/conventions.h"

namespace acentric::editor {

/// The nearest angle that a project file can hold, radians; beyond a whole turn the same direction within
/// half a turn.
inline double storedAngle(double radiansValue) {
  constexpr double kSteps = 1e9;  // per degree
  const double angle = degrees(radiansValue);
  const double within = std::abs(angle) > 360 ? std::remainder(angle, 360) : angle;
  return radians(std::round(within * kSteps) / kSteps);
}

}  // namespace acentric::editor
