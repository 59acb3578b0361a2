#pragma once
/// What is seen where there is nothing else: the same from every place.

#include <glm/glm.hpp>

namespace acentric {

/// Light from all around: sky above, its bounce below. Radiance by the z of a unit direction: mix
/// horizon->zenith above, ground below. All zero = none.
struct Sky {
  glm::vec3 zenith{0};
  glm::vec3 horizon{0};
  glm::vec3 ground{0};
  bool present() const { return *this != Sky{}; }
  glm::vec3 radiance(const glm::vec3& direction) const {
    return direction.z < 0 ? ground : glm::mix(horizon, zenith, glm::min(direction.z, 1.0f));
  }
  bool operator==(const Sky&) const = default;
};

}  // namespace acentric
