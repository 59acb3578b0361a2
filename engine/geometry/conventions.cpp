#include "engine/geometry/conventions.h"

#include <cmath>

namespace acentric {

double wrapAngle(double value) {
  double wrapped = std::fmod(value, kTwoPi);
  if (wrapped < 0) wrapped += kTwoPi;
  return wrapped >= kTwoPi ? 0 : wrapped;  // a tiny negative value rounds up to 2 pi
}

glm::dvec2 directionOf(double azimuth) { return {std::cos(azimuth), std::sin(azimuth)}; }

}  // namespace acentric
