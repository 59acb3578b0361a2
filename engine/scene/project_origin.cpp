#include "engine/scene/project_origin.h"

#include <algorithm>
#include <cmath>

namespace acentric {

glm::dvec3 projectOriginFor(const glm::dvec3& min, const glm::dvec3& max) {
  const glm::dvec3 centre = 0.5 * (min + max);
  const double distance = glm::length(centre);
  const double reach = 0.5 * glm::length(max - min);
  const bool far = distance > 10000;
  const bool coarse =
      distance > 4 * reach && (distance + reach > 1000 ||  // a float's step is above 0.06 mm there
                               distance > 1000 * reach);   // or above an 8000th of the scene
  if (!far && !coarse) return glm::dvec3(0);
  const double step = reach > 0 ? std::min(1.0, std::exp2(std::floor(std::log2(reach)))) : 1;
  return glm::round(centre / step) * step;
}

}  // namespace acentric
