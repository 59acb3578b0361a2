#pragma once
/// Where a scene's positions are counted from.

#include <glm/glm.hpp>

namespace acentric {

/// For a scene within these corners, metres: zero, but near a scene that is far away. Floats keep 24 bits:
/// far from zero they lose the millimetres, or of a small scene its details. Whole metres (of small scenes:
/// halves, quarters ...) keep the origin exact in any format.
glm::dvec3 projectOriginFor(const glm::dvec3& min, const glm::dvec3& max);

}  // namespace acentric
