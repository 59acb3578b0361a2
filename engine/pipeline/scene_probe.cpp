#include "engine/pipeline/scene_probe.h"

namespace acentric {

SurfaceProbe probeFor(const RayScene& rays) {
  return [&rays](const glm::dvec3& origin, const glm::dvec3& direction) -> SurfaceHit {
    const Hit hit = rays.trace({glm::vec3(origin), glm::vec3(direction)});
    if (!hit.found()) return {};
    return {hit.distance, glm::dvec3(hit.geometricNormal())};
  };
}

}  // namespace acentric
