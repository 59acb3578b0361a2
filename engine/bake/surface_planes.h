#pragma once
/// The plane of a surface as a capture's samples keep it (image/capture.h).

#include "engine/bake/ray_scene.h"
#include "engine/image/capture.h"

namespace acentric {

/// Of the triangle that a ray from `centre` in `direction` (unit) hits; the same bits for each of the
/// triangle's hits. A triangle that is seen nearly edge on (below 0.06 degrees) says nothing about its
/// neighbourhood: it gets the plane that faces the ray.
SurfacePlane planeOf(const Scene& scene, const Hit& hit, const glm::dvec3& centre, const glm::vec3& direction,
                     bool away);

/// Of the virtual image of a hit that a plane mirror (its normal, either way) shows at centre + `way`.
SurfacePlane imagePlaneOf(const Hit& hit, const glm::vec3& mirrorNormal, const glm::dvec3& way);

}  // namespace acentric
