#include "engine/measure/surface_steps.h"

#include <algorithm>
#include <cmath>

namespace acentric {

bool oneSurface(const FloatImage& distance, const PixelLine& line, std::size_t i) {
  constexpr double kJump = 3, kSlack = 0.004;
  const auto inverse = [&](std::size_t k) { return 1 / double(distance.pixels[line.at(k)]); };
  const double here = inverse(i), next = inverse(i + 1);
  double beside = 0;
  if (i > 0) beside = std::max(beside, std::abs(here - inverse(i - 1)));
  if (i + 2 < line.length) beside = std::max(beside, std::abs(inverse(i + 2) - next));
  const double jump = std::abs(next - here);
  // Where both neighbours jump too, as across a thin rod, all of it is silhouettes.
  return jump <= kJump * beside + kSlack * here && jump <= 0.2 * std::max(here, next);
}

}  // namespace acentric
